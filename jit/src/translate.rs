//! A program as machine code: one function without branches.
//!
//! It takes an array of pointers to what it reads, one of pointers to what it writes, and the function that it calls first of all,
//! to turn its angles into sines and cosines, eight at a time. Elements that are always 0 are not written: results are 0 before
//! the call.
//!
//! What was measured, on ssrms: constants from a table, read anew at each use, since an instruction reads one argument from memory
//! at no cost, against constants by way of integer registers; all other inputs read once, against anew at each use (∇w_D 7 % slower);
//! steps in the order of the program, against depth first (M and the inverse dynamics 8 % slower); the code generator's own
//! optimizations, which find nothing to do but move what is in a good order (∇w_D 13 % slower).

use std::collections::HashMap;

use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::types::F64;
use cranelift_codegen::ir::{
    AbiParam, Function, InstBuilder, MemFlags, Signature, StackSlotData, StackSlotKind, Value,
};
use ulna::{Argument, Method, Payload};
use ulna_codegen::internal::{Summand, fused_summands};
use ulna_codegen::{AngleSum, Input, Op, Operand, Program};

use crate::Error;
use crate::code::Layout;
use crate::host::Host;
use crate::shape;

/// The inputs before a method's arguments.
pub(crate) const CONSTANTS: usize = 0;
pub(crate) const PAYLOAD: usize = 1;
pub(crate) const ARGUMENTS: usize = 2;

/// A number's bytes.
const NUMBER: usize = size_of::<f64>();

/// So many sines are taken at once.
const EIGHT: usize = 8;

const TOO_LONG: &str = "it is too long";

/// A function's bytes and what it reads.
pub(crate) struct Translated {
    pub(crate) bytes: Vec<u8>,
    pub(crate) constants: Vec<f64>,
    pub(crate) layout: Layout,
}

/// Makes the function of a method's program.
pub(crate) fn translate(
    host: &Host,
    method: Method,
    program: &Program,
    joints: usize,
) -> Result<Translated, Error> {
    let failed = |reason: String| Error::Program { method, reason };
    let layout = layout(method, joints);
    check(program, &layout).map_err(failed)?;
    let mut context = Context::new();
    let constants = Translator::new(host, &mut context.func, method, &layout)
        .and_then(|translator| translator.translate(program))
        .map_err(failed)?;
    let compiled = context
        .compile(
            host.isa_for(program.steps.len()),
            &mut ControlPlane::default(),
        )
        .map_err(|error| failed(format!("{:?}", error.inner)))?;
    if !compiled.buffer.relocs().is_empty() {
        return Err(failed("its code is not complete in itself".to_owned()));
    }
    let bytes = compiled.code_buffer().to_vec();
    let mut layout = layout;
    layout.inputs[CONSTANTS] = constants.len();
    Ok(Translated {
        bytes,
        constants,
        layout,
    })
}

/// What the function reads and writes; constants are not counted yet.
fn layout(method: Method, joints: usize) -> Layout {
    let arguments = method.arguments().iter();
    let before = [0, Payload::PARAMETERS];
    Layout {
        inputs: before
            .into_iter()
            .chain(arguments.map(|argument| argument.length(joints)))
            .collect(),
        results: shape::lengths(&shape::kernel_shape(method, joints)),
    }
}

/// Whether the program's results are those of the method, and each step is computed before it is read.
fn check(program: &Program, layout: &Layout) -> Result<(), String> {
    let results = program.outputs.iter().map(|output| output.elements.len());
    if !results.eq(layout.results.iter().copied()) {
        return Err("its results are of other shapes".to_owned());
    }
    for (index, step) in program.steps.iter().enumerate() {
        for operand in [step.a, step.b] {
            if let Operand::Step(read) = operand
                && read >= index
            {
                return Err(format!("step {index} reads step {read}"));
            }
        }
    }
    let elements = program.outputs.iter().flat_map(|output| &output.elements);
    for element in elements {
        if let Operand::Step(read) = element
            && *read >= program.steps.len()
        {
            return Err(format!("a result is step {read}, which there is not"));
        }
    }
    Ok(())
}

/// The function in the making.
struct Translator<'a> {
    cursor: FuncCursor<'a>,
    fuses: bool,
    method: Method,
    layout: &'a Layout,
    /// The pointer to each input, and to each result.
    inputs: Vec<Value>,
    results: Vec<Value>,
    /// The function for sines.
    sines: Value,
    /// Where they are, for every eight angles: sines, and cosines behind them.
    angles: Vec<Value>,
    /// What has been read, by pointer and place.
    kept: HashMap<(Value, i32), Value>,
    constants: Vec<f64>,
    /// Their places in the table, by their bits.
    places: HashMap<u64, usize>,
    /// The results of the steps; none of a product that is fused with its sum.
    values: Vec<Option<Value>>,
}

impl<'a> Translator<'a> {
    fn new(
        host: &Host,
        function: &'a mut Function,
        method: Method,
        layout: &'a Layout,
    ) -> Result<Self, String> {
        let pointer = host.isa_for(0).pointer_type();
        function.signature.call_conv = host.isa_for(0).default_call_conv();
        function.signature.params = vec![AbiParam::new(pointer); 3];
        let block = function.dfg.make_block();
        let [from, to, sines] = [(); 3].map(|()| function.dfg.append_block_param(block, pointer));
        let mut cursor = FuncCursor::new(function);
        cursor.insert_block(block);
        let mut pointers = |array: Value, count: usize| -> Result<Vec<Value>, String> {
            (0..count)
                .map(|index| {
                    let place = offset(index, count, pointer.bytes() as usize)?;
                    Ok(cursor.ins().load(pointer, flags(), array, place))
                })
                .collect()
        };
        let inputs = pointers(from, layout.inputs.len())?;
        let results = pointers(to, layout.results.len())?;
        Ok(Self {
            cursor,
            fuses: host.fuses,
            method,
            layout,
            inputs,
            results,
            sines,
            angles: Vec::new(),
            kept: HashMap::new(),
            constants: Vec::new(),
            places: HashMap::new(),
            values: Vec::new(),
        })
    }

    /// Appends all of the program, and returns the table of its constants.
    fn translate(mut self, program: &Program) -> Result<Vec<f64>, String> {
        let fused = if self.fuses {
            fused_summands(program)
        } else {
            vec![None; program.steps.len()]
        };
        let is_fused = fused_products(program, &fused);
        self.take_sines(&program.angles)?;
        let elements = elements(program);
        for (index, step) in program.steps.iter().enumerate() {
            let value = if is_fused[index] {
                None
            } else {
                Some(match fused[index] {
                    Some(summand) => self.multiply_add(program, index, summand)?,
                    None => self.step(step.op, step.a, step.b)?,
                })
            };
            self.values.push(value);
            if let Some(value) = value {
                for place in elements.get(&index).into_iter().flatten() {
                    self.store(value, *place)?;
                }
            }
        }
        for (part, output) in program.outputs.iter().enumerate() {
            for (place, element) in output.elements.iter().enumerate() {
                let is_zero = matches!(element, Operand::Constant(value) if value.to_f64() == 0.0);
                if !is_zero && !matches!(element, Operand::Step(_)) {
                    let value = self.operand(*element)?;
                    self.store(value, (part, place))?;
                }
            }
        }
        self.cursor.ins().return_(&[]);
        Ok(self.constants)
    }

    /// Has the sines and cosines of all angles written onto the stack, eight by eight.
    fn take_sines(&mut self, angles: &[AngleSum]) -> Result<(), String> {
        let pointer = self.cursor.func.dfg.value_type(self.sines);
        let mut signature = Signature::new(self.cursor.func.signature.call_conv);
        signature.params = vec![AbiParam::new(F64); 1 + EIGHT];
        signature.params[0] = AbiParam::new(pointer);
        let signature = self.cursor.func.import_signature(signature);
        for block in angles.chunks(EIGHT) {
            let bytes = u32::try_from(2 * EIGHT * NUMBER).map_err(|_| TOO_LONG)?;
            let slot = StackSlotData::new(StackSlotKind::ExplicitSlot, bytes, 4);
            let slot = self.cursor.func.create_sized_stack_slot(slot);
            let address = self.cursor.ins().stack_addr(pointer, slot, 0);
            let mut arguments = vec![address];
            for angle in block {
                arguments.push(self.sum(angle)?);
            }
            // What is beyond the last angle is the sine of the first.
            arguments.resize(1 + EIGHT, arguments[1]);
            let sines = self.sines;
            self.cursor
                .ins()
                .call_indirect(signature, sines, &arguments);
            self.angles.push(address);
        }
        Ok(())
    }

    fn sum(&mut self, angle: &AngleSum) -> Result<Value, String> {
        let mut sum = None;
        for joint in &angle.joints {
            let q = self.input(Input::Q(*joint))?;
            sum = Some(match sum {
                Some(sum) => self.cursor.ins().fadd(sum, q),
                None => q,
            });
        }
        match (sum, angle.offset.to_f64()) {
            (Some(sum), 0.0) => Ok(sum),
            (Some(sum), offset) => {
                let offset = self.constant(offset)?;
                Ok(self.cursor.ins().fadd(sum, offset))
            }
            (None, offset) => self.constant(offset),
        }
    }

    fn step(&mut self, op: Op, a: Operand, b: Operand) -> Result<Value, String> {
        let a = self.operand(a)?;
        let b = if op.row().arity == 2 {
            self.operand(b)?
        } else {
            a
        };
        let ins = self.cursor.ins();
        Ok(match op {
            Op::Add => ins.fadd(a, b),
            Op::Sub => ins.fsub(a, b),
            Op::Mul => ins.fmul(a, b),
            Op::Div => ins.fdiv(a, b),
            Op::Neg => ins.fneg(a),
            Op::Sqrt => ins.sqrt(a),
        })
    }

    /// A sum or difference, one of whose summands is a product that nothing else needs.
    fn multiply_add(
        &mut self,
        program: &Program,
        index: usize,
        summand: Summand,
    ) -> Result<Value, String> {
        let step = program.steps[index];
        let (product, other) = match summand {
            Summand::First => (step.a, step.b),
            Summand::Second => (step.b, step.a),
        };
        let Operand::Step(product) = product else {
            return Err("it fuses what is no product".to_owned());
        };
        let product = program.steps[product];
        let (a, b) = (self.operand(product.a)?, self.operand(product.b)?);
        let other = self.operand(other)?;
        let is_difference = step.op == Op::Sub;
        Ok(match summand {
            Summand::First if is_difference => {
                let other = self.cursor.ins().fneg(other);
                self.cursor.ins().fma(a, b, other)
            }
            Summand::Second if is_difference => {
                let a = self.cursor.ins().fneg(a);
                self.cursor.ins().fma(a, b, other)
            }
            _ => self.cursor.ins().fma(a, b, other),
        })
    }

    fn operand(&mut self, operand: Operand) -> Result<Value, String> {
        match operand {
            Operand::Constant(value) => self.constant(value.to_f64()),
            Operand::Input(input) => self.input(input),
            Operand::Step(step) => match self.values.get(step) {
                Some(Some(value)) => Ok(*value),
                _ => Err(format!("it reads step {step} before it is computed")),
            },
        }
    }

    fn constant(&mut self, value: f64) -> Result<Value, String> {
        let next = self.constants.len();
        let place = *self.places.entry(value.to_bits()).or_insert(next);
        if place == next {
            self.constants.push(value);
        }
        let place = offset(place, self.constants.len(), NUMBER)?;
        let table = self.inputs[CONSTANTS];
        Ok(self.cursor.ins().load(F64, flags(), table, place))
    }

    fn input(&mut self, input: Input) -> Result<Value, String> {
        let (slice, index) = match input {
            Input::Sin(angle) => return self.sine(angle, 0),
            Input::Cos(angle) => return self.sine(angle, 1),
            Input::Payload(index) => (PAYLOAD, index),
            Input::Q(index) => (self.argument(Argument::Q)?, index),
            Input::Qd(index) => (self.argument(Argument::Qd)?, index),
            Input::Qdd(index) => (self.argument(Argument::Qdd)?, index),
            Input::Tau(index) => (self.argument(Argument::Tau)?, index),
            Input::Wrench(index) => (self.argument(Argument::Wrench)?, index),
        };
        let place = offset(index, self.layout.inputs[slice], NUMBER)?;
        Ok(self.kept(self.inputs[slice], place))
    }

    /// The sine, or the cosine, of an angle.
    fn sine(&mut self, angle: usize, which: usize) -> Result<Value, String> {
        let address = *self
            .angles
            .get(angle / EIGHT)
            .ok_or("it has not so many angles")?;
        let place = offset(which * EIGHT + angle % EIGHT, 2 * EIGHT, NUMBER)?;
        Ok(self.kept(address, place))
    }

    fn argument(&self, argument: Argument) -> Result<usize, String> {
        let mut arguments = self.method.arguments().iter();
        let place = arguments.position(|own| *own == argument);
        let place = place.ok_or_else(|| format!("it reads `{}`", argument.name()))?;
        Ok(ARGUMENTS + place)
    }

    /// The number at a place of an input, read once.
    fn kept(&mut self, pointer: Value, place: i32) -> Value {
        if let Some(value) = self.kept.get(&(pointer, place)) {
            return *value;
        }
        let value = self.cursor.ins().load(F64, flags(), pointer, place);
        self.kept.insert((pointer, place), value);
        value
    }

    fn store(&mut self, value: Value, (part, place): (usize, usize)) -> Result<(), String> {
        let place = offset(place, self.layout.results[part], NUMBER)?;
        let pointer = self.results[part];
        self.cursor.ins().store(flags(), value, pointer, place);
        Ok(())
    }
}

/// Pointers are good, and aligned.
fn flags() -> MemFlags {
    MemFlags::trusted()
}

/// The bytes before the entry at `index` of a slice of so many.
fn offset(index: usize, length: usize, size: usize) -> Result<i32, String> {
    if index >= length {
        return Err(format!("it reads entry {index} of {length}"));
    }
    i32::try_from(index * size).map_err(|_| TOO_LONG.to_owned())
}

/// Which steps are products that are fused with the sum that needs them.
fn fused_products(program: &Program, fused: &[Option<Summand>]) -> Vec<bool> {
    let mut is_fused = vec![false; program.steps.len()];
    for (step, summand) in program.steps.iter().zip(fused) {
        let product = match summand {
            Some(Summand::First) => step.a,
            Some(Summand::Second) => step.b,
            None => continue,
        };
        if let Operand::Step(product) = product {
            is_fused[product] = true;
        }
    }
    is_fused
}

/// The part and place of each element of the results that a step computes.
fn elements(program: &Program) -> HashMap<usize, Vec<(usize, usize)>> {
    let mut elements: HashMap<usize, Vec<(usize, usize)>> = HashMap::new();
    for (part, output) in program.outputs.iter().enumerate() {
        for (place, element) in output.elements.iter().enumerate() {
            if let Operand::Step(step) = element {
                elements.entry(*step).or_default().push((part, place));
            }
        }
    }
    elements
}
