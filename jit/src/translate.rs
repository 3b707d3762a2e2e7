//! A program as machine code: one function without branches or calls.
//!
//! It takes two arguments, an array of pointers to what it reads and one of pointers to what it writes. Constants are read from a
//! table, and like every input anew at each use: an instruction reads one argument from memory at no cost, and a register is free
//! for what has been computed. Elements that are always 0 are not written: results are 0 before the call.

use std::collections::HashMap;

use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::types::F64;
use cranelift_codegen::ir::{AbiParam, Function, InstBuilder, MemFlags, Value};
use ulna::{Argument, Method, Payload};
use ulna_codegen::internal::{Summand, fused_summands};
use ulna_codegen::{Input, Op, Operand, Program};

use crate::Error;
use crate::angles::stride;
use crate::code::Layout;
use crate::host::Host;
use crate::shape;

/// The inputs before a method's arguments.
pub(crate) const CONSTANTS: usize = 0;
pub(crate) const SINES: usize = 1;
pub(crate) const PAYLOAD: usize = 2;
pub(crate) const ARGUMENTS: usize = 3;

/// A number's bytes.
const NUMBER: usize = size_of::<f64>();

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
    let layout = layout(method, program, joints);
    check(program, &layout, joints).map_err(failed)?;
    let mut context = Context::new();
    let constants = Translator::new(host, &mut context.func, method, &layout)
        .and_then(|translator| translator.translate(program))
        .map_err(failed)?;
    let compiled = context
        .compile(&*host.isa, &mut ControlPlane::default())
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
fn layout(method: Method, program: &Program, joints: usize) -> Layout {
    let arguments = method.arguments().iter();
    let before = [0, 2 * stride(program.angles.len()), Payload::PARAMETERS];
    Layout {
        inputs: before
            .into_iter()
            .chain(arguments.map(|argument| argument.length(joints)))
            .collect(),
        results: shape::lengths(&shape::kernel_shape(method, joints)),
    }
}

/// Whether the program's results are those of the method, and its angles those of the arm's joints.
fn check(program: &Program, layout: &Layout, joints: usize) -> Result<(), String> {
    let results = program.outputs.iter().map(|output| output.elements.len());
    if !results.eq(layout.results.iter().copied()) {
        return Err("its results are of other shapes".to_owned());
    }
    let angles = program.angles.iter();
    if angles
        .flat_map(|angle| &angle.joints)
        .any(|joint| *joint >= joints)
    {
        return Err("it takes the angle of a joint that the arm has not".to_owned());
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
        let pointer = host.isa.pointer_type();
        function.signature.call_conv = host.isa.default_call_conv();
        function.signature.params = vec![AbiParam::new(pointer); 2];
        let block = function.dfg.make_block();
        let [from, to] = [(); 2].map(|()| function.dfg.append_block_param(block, pointer));
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
        Ok(self.read(CONSTANTS, place))
    }

    fn input(&mut self, input: Input) -> Result<Value, String> {
        let angles = self.layout.inputs[SINES] / 2;
        let (slice, index) = match input {
            Input::Sin(angle) => (SINES, angle),
            Input::Cos(angle) => (SINES, angles + angle),
            Input::Payload(index) => (PAYLOAD, index),
            Input::Q(index) => (self.argument(Argument::Q)?, index),
            Input::Qd(index) => (self.argument(Argument::Qd)?, index),
            Input::Qdd(index) => (self.argument(Argument::Qdd)?, index),
            Input::Tau(index) => (self.argument(Argument::Tau)?, index),
            Input::Wrench(index) => (self.argument(Argument::Wrench)?, index),
        };
        let place = offset(index, self.layout.inputs[slice], NUMBER)?;
        Ok(self.read(slice, place))
    }

    fn argument(&self, argument: Argument) -> Result<usize, String> {
        let mut arguments = self.method.arguments().iter();
        let place = arguments.position(|own| *own == argument);
        let place = place.ok_or_else(|| format!("it reads `{}`", argument.name()))?;
        Ok(ARGUMENTS + place)
    }

    fn read(&mut self, slice: usize, place: i32) -> Value {
        let pointer = self.inputs[slice];
        self.cursor
            .ins()
            .load(F64, flags().with_readonly(), pointer, place)
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
    i32::try_from(index * size).map_err(|_| "it is too long".to_owned())
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
