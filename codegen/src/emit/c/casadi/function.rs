//! A function for CasADi and its Jacobian, as C.

use std::fmt::Write as _;

use ulna::{Method, Payload};

use super::super::target::Target;
use super::block::Block;
use super::interface::Interface;
use crate::{Compiled, MethodProgram};

/// A function of CasADi with one output, and its Jacobian.
#[derive(Debug)]
pub(super) struct Function {
    value: Interface,
    jacobian: Interface,
    /// The statement that computes the output.
    call: String,
    results: Vec<Computed>,
}

/// Blocks, of inputs that follow each other, that are made together.
#[derive(Debug)]
struct Computed {
    blocks: Vec<Block>,
    /// How many numbers they are taken from.
    length: usize,
    /// The statements that leave these in `result`.
    statements: Vec<String>,
}

impl Function {
    /// (q, q̇, q̈) → τ, and the payload's parameters behind these if the arm has one; `None` where a method is not compiled.
    pub(super) fn inverse_dynamics(target: &Target<'_>, compiled: &Compiled) -> Option<Self> {
        let n = target.joints().len();
        let derivatives = Method::InverseDynamicsDerivatives;
        let square = |method, part| Block::of(compiled, method, part, n, n);
        let by_state = vec![square(derivatives, 0)?, square(derivatives, 1)?];
        let by_acceleration = vec![square(Method::MassMatrix, 0)?];
        let mut results = vec![
            Computed::by(target, compiled, derivatives, by_state)?,
            Computed::by(target, compiled, Method::MassMatrix, by_acceleration)?,
        ];
        if target.model.has_payload() {
            // Torques are linear in the parameters of the last link, and so in those of what it carries.
            let last = Block::of(compiled, Method::Regressor, 0, n, Payload::PARAMETERS)?;
            results.push(Computed::by(
                target,
                compiled,
                Method::Regressor,
                vec![last],
            )?);
        }
        Self::new(target, compiled, Method::InverseDynamics, "tau", results)
    }

    /// (q, q̇, τ) → q̈, likewise.
    pub(super) fn forward_dynamics(target: &Target<'_>, compiled: &Compiled) -> Option<Self> {
        let n = target.joints().len();
        let derivatives = Method::ForwardDynamicsDerivatives;
        let blocks = (0..3).map(|part| Block::of(compiled, derivatives, part, n, n));
        let blocks = blocks.collect::<Option<_>>()?;
        let mut results = vec![Computed::by(target, compiled, derivatives, blocks)?];
        if target.model.has_payload() {
            results.push(accelerations_by_payload(target, compiled)?);
        }
        Self::new(target, compiled, Method::ForwardDynamics, "qdd", results)
    }

    fn new(
        target: &Target<'_>,
        compiled: &Compiled,
        method: Method,
        output: &str,
        results: Vec<Computed>,
    ) -> Option<Self> {
        let n = target.joints().len();
        let name = target.own(&format!("casadi_{method}"));
        let payload = target
            .model
            .has_payload()
            .then_some(("payload", Payload::PARAMETERS));
        let inputs = method.arguments().iter();
        let inputs = inputs
            .map(|input| (input.name(), input.length(n)))
            .chain(payload);
        let inputs: Vec<(String, Vec<usize>)> = inputs
            .map(|(name, length)| (name.to_owned(), vec![length, 1, 1]))
            .collect();
        let blocks = results.iter().flat_map(|result| &result.blocks);
        let by_inputs = inputs
            .iter()
            .zip(blocks)
            .map(|((input, _), block)| (format!("jac_{output}_{input}"), block.sparsity()));
        let by_inputs = by_inputs.collect();
        // The output where the Jacobian is taken: it is not used, and so passed without entries.
        let nominal = (format!("out_{output}"), vec![n, 1, 0, 0]);
        Some(Self {
            jacobian: Interface {
                name: format!("jac_{name}"),
                inputs: inputs.iter().cloned().chain([nominal]).collect(),
                outputs: by_inputs,
            },
            value: Interface {
                name,
                inputs,
                outputs: vec![(output.to_owned(), vec![n, 1, 1])],
            },
            call: call(target, compiled, method, "res[0]")?,
            results,
        })
    }

    /// What the header says of both.
    pub(super) fn prototypes(&self) -> String {
        self.value.prototypes() + &self.jacobian.prototypes()
    }

    /// Both functions.
    pub(super) fn definitions(&self) -> String {
        let value = self.given() + &wanted(0..1, std::slice::from_ref(&self.call));
        let mut jacobian = self.given();
        let mut first = 0;
        for Computed {
            blocks,
            length,
            statements,
        } in &self.results
        {
            let places = first..first + blocks.len();
            first = places.end;
            let mut lines = vec![format!("double result[{length}];"), String::new()];
            lines.extend(statements.iter().cloned());
            lines.extend(places.clone().zip(blocks).map(|(i, block)| {
                let pattern = self.jacobian.sparsity_of(i);
                format!("pick(&result[{}], {pattern}, res[{i}]);", block.start)
            }));
            jacobian.push_str(&wanted(places, &lines));
        }
        self.value.definitions(&value) + &self.jacobian.definitions(&jacobian)
    }

    /// The inputs as arrays.
    fn given(&self) -> String {
        let mut text = String::new();
        for (i, (name, _)) in self.value.inputs.iter().enumerate() {
            // Writing to a String does not fail.
            let _ = writeln!(text, "    const double *const {name} = given(arg[{i}]);");
        }
        text
    }
}

impl Computed {
    /// Blocks of the results of a method.
    fn by(
        target: &Target<'_>,
        compiled: &Compiled,
        method: Method,
        blocks: Vec<Block>,
    ) -> Option<Self> {
        Some(Self {
            blocks,
            length: length(compiled, method)?,
            statements: vec![call(target, compiled, method, "result")?],
        })
    }
}

/// ∂q̈/∂π = −M⁻¹ ∂τ/∂π for the payload's parameters π, ∂τ/∂π at q̈ of the torques; M⁻¹ is ∂q̈/∂τ.
fn accelerations_by_payload(target: &Target<'_>, compiled: &Compiled) -> Option<Computed> {
    let n = target.joints().len();
    let (columns, inverse) = (Payload::PARAMETERS, Method::ForwardDynamicsDerivatives);
    let inverse_start = Block::of(compiled, inverse, 2, n, n)?.start;
    let torques = Block::of(compiled, Method::Regressor, 0, n, columns)?;
    let statements = [
        format!("double qdd[{n}];"),
        format!("double derivatives[{}];", length(compiled, inverse)?),
        format!(
            "double regressor[{}];",
            length(compiled, Method::Regressor)?
        ),
        String::new(),
        call(target, compiled, Method::ForwardDynamics, "qdd")?,
        call(target, compiled, inverse, "derivatives")?,
        call(target, compiled, Method::Regressor, "regressor")?,
        format!(
            "solved(&derivatives[{inverse_start}], &regressor[{}], {n}, {columns}, result);",
            torques.start
        ),
    ];
    Some(Computed {
        blocks: vec![Block::full(n, columns)],
        length: n * columns,
        statements: statements.into(),
    })
}

/// How many numbers a method's result is.
fn length(compiled: &Compiled, method: Method) -> Option<usize> {
    let outputs = &MethodProgram::of(&compiled.methods, method)?
        .program
        .outputs;
    Some(outputs.iter().map(|output| output.elements.len()).sum())
}

/// The statement that calls a method's function.
fn call(target: &Target<'_>, compiled: &Compiled, method: Method, result: &str) -> Option<String> {
    MethodProgram::of(&compiled.methods, method)?;
    let has_payload = target.model.has_payload();
    let arguments = method.arguments().iter().map(|argument| argument.name());
    let arguments = arguments
        .chain(has_payload.then_some("payload"))
        .chain([result]);
    let arguments: Vec<&str> = arguments.collect();
    Some(format!(
        "{}({});",
        target.own(method.name()),
        arguments.join(", ")
    ))
}

/// Statements that are run if one of these outputs is wanted.
fn wanted(outputs: std::ops::Range<usize>, statements: &[String]) -> String {
    let conditions: Vec<String> = outputs.map(|i| format!("res[{i}] != NULL")).collect();
    let condition = match conditions.as_slice() {
        [only] => only.clone(),
        several => format!("({})", several.join(") || (")),
    };
    let statements = statements.iter().map(|statement| {
        if statement.is_empty() {
            "\n".to_owned()
        } else {
            format!("        {statement}\n")
        }
    });
    format!(
        "    if ({condition})\n    {{\n{}    }}\n",
        statements.collect::<String>()
    )
}
