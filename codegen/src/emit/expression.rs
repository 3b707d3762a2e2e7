//! Steps of a program as Rust expressions.
//!
//! A value that is used once stands where it is used, if that stays readable; the others are named.
//! A product that only a sum needs becomes a multiply-add: [`ulna::Real`] fuses it where the target can.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::latency::{Summand, fused};
use super::literal::literal;
use super::names::{Names, angle_names};
use crate::graph::Input;
use crate::label::Label;
use crate::op::Op;
use crate::schedule::{Operand, Output, Program, Step};

/// The most operations that an unnamed value may have in it.
const INLINE: usize = 5;

/// Binding strength of an expression's outermost operator.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Negation,
    Atom,
}

struct Code {
    tokens: TokenStream,
    level: Level,
}

impl Code {
    fn atom(tokens: TokenStream) -> Self {
        Self {
            tokens,
            level: Level::Atom,
        }
    }

    /// The tokens, in parentheses unless they bind at least as strongly as `level`.
    fn at(&self, level: Level) -> TokenStream {
        let tokens = &self.tokens;
        if self.level >= level {
            quote!(#tokens)
        } else {
            quote!((#tokens))
        }
    }
}

/// A program's steps as named values and the expressions of its outputs.
pub(super) struct Writer<'p> {
    program: &'p Program,
    /// The name of each step that has one.
    names: Vec<Option<Ident>>,
    /// Which summand of each step is fused with it.
    fused: Vec<Option<Summand>>,
    /// The names of steps that are results and nothing else.
    results: HashMap<usize, Ident>,
    angle_names: Vec<String>,
}

impl<'p> Writer<'p> {
    /// Decides which steps are named: those that are used more than once, or not short, and results, which are named last.
    ///
    /// A name is the value's own, if the formulas gave it one, or else a number.
    pub(super) fn new(program: &'p Program) -> Self {
        let angle_names = angle_names(&program.angles);
        let mut given = Names::new(program, &angle_names);
        let inline = inlined(program);
        let names: Vec<Option<Ident>> = (0..program.steps.len())
            .map(|step| (!inline[step]).then(|| given.name(step)))
            .collect();
        let mut results = HashMap::new();
        for element in program.outputs.iter().flat_map(|output| &output.elements) {
            if let Operand::Step(step) = *element
                && inline[step]
                && !is_plain(program, &names, step)
            {
                results.insert(step, given.name(step));
            }
        }
        Self {
            program,
            fused: fused(program, &inline),
            names,
            results,
            angle_names,
        }
    }

    /// Every named value and its expression, in order.
    pub(super) fn named(&self) -> Vec<(Ident, TokenStream)> {
        let names = self.names.iter().enumerate();
        names
            .filter_map(|(step, name)| Some((name.clone()?, self.step(step).tokens)))
            .collect()
    }

    /// The results that have a name of their own, and their expressions, in order.
    pub(super) fn named_results(&self) -> Vec<(Ident, TokenStream)> {
        let outputs = self.program.outputs.iter();
        let elements = outputs.flat_map(|output| &output.elements);
        elements
            .filter_map(|element| {
                let Operand::Step(step) = element else {
                    return None;
                };
                let name = self.results.get(step)?.clone();
                Some((name, self.value(*element)))
            })
            .collect()
    }

    /// The labels of the steps that are named, results among them if they are `with_results`.
    pub(super) fn labels(&self, with_results: bool) -> impl Iterator<Item = &'p Label> {
        let is_named = move |step: usize| {
            self.names[step].is_some() || (with_results && self.results.contains_key(&step))
        };
        let labels = self.program.labels.iter().enumerate();
        labels.filter_map(move |(step, label)| label.as_ref().filter(|_| is_named(step)))
    }

    /// The step behind every named value, in order.
    pub(super) fn named_steps(&self) -> Vec<Step> {
        let steps = self.names.iter().zip(&self.program.steps);
        let steps = steps.filter_map(|(name, step)| name.is_some().then_some(*step));
        steps.collect()
    }

    /// A value as an expression.
    pub(super) fn value(&self, operand: Operand) -> TokenStream {
        self.operand(operand).tokens
    }

    /// Appends the names in the expression of a value: of other values, sines and cosines, arguments.
    pub(super) fn names_in(&self, operand: Operand, names: &mut Vec<Ident>) {
        match operand {
            Operand::Step(index) => match &self.names[index] {
                Some(name) => names.push(name.clone()),
                None => self.names_in_step(&self.program.steps[index], names),
            },
            Operand::Input(input) => names.push(self.input_name(input)),
            Operand::Constant(_) => {}
        }
    }

    /// Appends the names in the expression of a step.
    pub(super) fn names_in_step(&self, step: &Step, names: &mut Vec<Ident>) {
        self.names_in(step.a, names);
        if step.op.row().arity == 2 {
            self.names_in(step.b, names);
        }
    }

    /// An output as nested arrays.
    pub(super) fn output(&self, output: &Output<Operand>) -> TokenStream {
        let mut rows: Vec<TokenStream> = output
            .elements
            .iter()
            .map(|e| match e {
                Operand::Step(step) if self.results.contains_key(step) => {
                    let name = &self.results[step];
                    quote!(#name)
                }
                _ => self.operand(*e).tokens,
            })
            .collect();
        for length in output.shape.iter().rev() {
            rows = rows
                .chunks(*length)
                .map(|row| quote!([#(#row),*]))
                .collect();
        }
        quote!(#(#rows)*)
    }

    /// Names of an angle's sine and cosine; none for one that is not used.
    pub(super) fn angle(&self, index: usize) -> (Option<Ident>, Option<Ident>) {
        let name = |input| self.uses_input(input).then(|| self.input_name(input));
        (name(Input::Sin(index)), name(Input::Cos(index)))
    }

    /// Whether the program reads the argument of that name.
    pub(super) fn uses_argument(&self, name: &str) -> bool {
        let reads = |operand: Operand| match operand {
            Operand::Input(input) => self.input_name(input) == name,
            _ => false,
        };
        self.any_operand(reads) || (name == "q" && !self.program.angles.is_empty())
    }

    fn uses_input(&self, input: Input) -> bool {
        self.any_operand(|operand| operand == Operand::Input(input))
    }

    fn any_operand(&self, is: impl Fn(Operand) -> bool) -> bool {
        let outputs = self.program.outputs.iter();
        self.program
            .steps
            .iter()
            .any(|step| is(step.a) || is(step.b))
            || outputs.flat_map(|output| &output.elements).any(|e| is(*e))
    }

    fn operand(&self, operand: Operand) -> Code {
        match operand {
            Operand::Constant(value) => {
                let value = literal(value.to_f64());
                Code::atom(quote!(R::of(#value)))
            }
            Operand::Input(input) => Code::atom(self.input(input)),
            Operand::Step(index) => match &self.names[index] {
                Some(name) => Code::atom(quote!(#name)),
                None => self.step(index),
            },
        }
    }

    fn input(&self, input: Input) -> TokenStream {
        let name = self.input_name(input);
        match input {
            Input::Q(i)
            | Input::Qd(i)
            | Input::Qdd(i)
            | Input::Tau(i)
            | Input::Wrench(i)
            | Input::Payload(i) => {
                let i = Literal::usize_unsuffixed(i);
                quote!(#name[#i])
            }
            Input::Sin(_) | Input::Cos(_) => quote!(#name),
        }
    }

    /// The name of an argument, or of a sine or cosine.
    fn input_name(&self, input: Input) -> Ident {
        match input {
            Input::Q(_) => format_ident!("q"),
            Input::Qd(_) => format_ident!("qd"),
            Input::Qdd(_) => format_ident!("qdd"),
            Input::Tau(_) => format_ident!("tau"),
            Input::Wrench(_) => format_ident!("wrench"),
            Input::Payload(_) => format_ident!("payload"),
            Input::Sin(angle) => format_ident!("s{}", self.angle_names[angle]),
            Input::Cos(angle) => format_ident!("c{}", self.angle_names[angle]),
        }
    }

    fn step(&self, index: usize) -> Code {
        let step = &self.program.steps[index];
        let (product, method, other) = match (self.fused[index], step.op) {
            (None, _) => return self.plain(step),
            (Some(Summand::First), Op::Add) => (step.a, "mul_add", step.b),
            (Some(Summand::Second), Op::Add) => (step.b, "mul_add", step.a),
            (Some(Summand::First), _) => (step.a, "mul_sub", step.b),
            (Some(Summand::Second), _) => (step.b, "neg_mul_add", step.a),
        };
        let Operand::Step(product) = product else {
            return self.plain(step);
        };
        let Step { a, b, .. } = self.program.steps[product];
        self.multiply_add((a, b), method, other)
    }

    fn plain(&self, step: &Step) -> Code {
        let (level, left, right) = match step.op {
            Op::Add | Op::Sub => (Level::Sum, Level::Sum, Level::Product),
            Op::Mul | Op::Div => (Level::Product, Level::Product, Level::Negation),
            Op::Neg => (Level::Negation, Level::Negation, Level::Atom),
            Op::Sqrt => (Level::Atom, Level::Atom, Level::Atom),
        };
        let (a, b) = (
            self.operand(step.a).at(left),
            self.operand(step.b).at(right),
        );
        Code {
            tokens: (step.op.row().tokens)(&a, &b),
            level,
        }
    }

    fn multiply_add(&self, (a, b): (Operand, Operand), method: &str, other: Operand) -> Code {
        // A number reads better as the argument.
        let (a, b) = match a {
            Operand::Constant(_) => (b, a),
            _ => (a, b),
        };
        let method = format_ident!("{method}");
        let receiver = self.operand(a).at(Level::Atom);
        let (factor, other) = (self.operand(b).tokens, self.operand(other).tokens);
        Code::atom(quote!(#receiver.#method(#factor, #other)))
    }
}

/// Which summand of each step is fused with it in the code that is emitted. Its product is then no operation of its own.
pub fn fused_summands(program: &Program) -> Vec<Option<Summand>> {
    fused(program, &inlined(program))
}

/// Whether a step is no more than the negative of something that has a name, and so needs none.
fn is_plain(program: &Program, names: &[Option<Ident>], step: usize) -> bool {
    let Step { op, a, .. } = program.steps[step];
    let unnamed = matches!(a, Operand::Step(step) if names[step].is_none());
    op == Op::Neg && !unnamed
}

/// Which steps are written where they are used: those used once and short, and products that a sum can fuse.
fn inlined(program: &Program) -> Vec<bool> {
    let mut uses = vec![0_usize; program.steps.len()];
    let mut summed = vec![false; program.steps.len()];
    let mut count = |operand: Operand, in_sum: bool| {
        if let Operand::Step(index) = operand {
            uses[index] += 1;
            summed[index] |= in_sum;
        }
    };
    for step in &program.steps {
        let in_sum = matches!(step.op, Op::Add | Op::Sub);
        count(step.a, in_sum);
        if step.op.row().arity == 2 {
            count(step.b, in_sum);
        }
    }
    for element in program.outputs.iter().flat_map(|output| &output.elements) {
        count(*element, false);
    }
    let mut sizes: Vec<usize> = Vec::with_capacity(program.steps.len());
    let mut inline = Vec::with_capacity(program.steps.len());
    for (index, step) in program.steps.iter().enumerate() {
        let size = |operand: Operand| match operand {
            Operand::Step(index) if inline[index] => sizes[index],
            _ => 0,
        };
        let own = match step.op.row().arity {
            1 => 1 + size(step.a),
            _ => 1 + size(step.a) + size(step.b),
        };
        let fusible = step.op == Op::Mul && summed[index];
        sizes.push(own);
        inline.push(uses[index] == 1 && (own <= INLINE || fusible));
    }
    inline
}
