//! Programs as C: the only place that knows that language's syntax.
//!
//! [`GeneratedC`] is a header with a documented prototype for each method, and a source file that defines them: C99, no allocation, nothing
//! but `sin`, `cos` and `sqrt` of the mathematical library.

mod casadi;
mod documentation;
mod expression;
mod function;
mod interface;
mod lines;
mod options;
mod parts;
mod payload;
mod support;
mod target;

use ulna::Method;
use ulna_table::Model;

pub use options::{Abi, COptions, Precision};

use super::plan::{Coordinates, Plan, header};
use crate::cost::Counts;
use crate::{Compiled, Stage};
use function::Function;
use interface::File;
use lines::comment;
use target::Target;

/// Above the methods that are not generated.
const ABSENT: &str = "Not generated:";

/// The C code of an arm: `NAME.h` and `NAME.c`, and `NAME_casadi.h` and `NAME_casadi.c` if they are asked for.
#[derive(Debug)]
pub struct GeneratedC {
    name: String,
    header: String,
    source: String,
    further: Vec<File>,
    counts: Vec<(Method, Counts)>,
    warnings: Vec<String>,
}

impl GeneratedC {
    /// The programs `compiled` of `model`'s arm. `source` names the table.
    ///
    /// [`Generator::generate_c`](crate::Generator::generate_c) does both; who wants several precisions compiles once.
    pub fn of(model: &Model, source: &str, compiled: &Compiled, options: COptions) -> Self {
        Self::watched(model, source, compiled, options, &|_| ())
    }

    /// The same; `watch` is told of every method before it is printed.
    pub(crate) fn watched(
        model: &Model,
        source: &str,
        compiled: &Compiled,
        options: COptions,
        watch: &dyn Fn(Stage),
    ) -> Self {
        let target = Target { model, options };
        let counts: Vec<_> = compiled
            .methods
            .iter()
            .map(|method| (method.method, Counts::of(&method.program)))
            .collect();
        let mut about = header(model, source, compiled, &counts, ABSENT);
        if options.precision == Precision::Float {
            about.push(
                "This is in single precision: all errors are 5.4e8 times as large.".to_owned(),
            );
        }
        let (mut prototypes, mut definitions) = (Vec::new(), Vec::new());
        if model.has_payload() {
            prototypes.push(payload::prototype(&target));
            definitions.push(payload::definition(&target));
        }
        for method in &compiled.methods {
            watch(Stage::Printing(method.method));
            let plan = Plan::new(method, model.joints().len(), Coordinates::Named);
            let function = Function::new(&target, &plan);
            prototypes.push(function.prototype());
            definitions.push(function.definition());
        }
        Self {
            name: model.name().to_owned(),
            header: header_file(&target, &about, &prototypes),
            source: source_file(&target, &about, &definitions),
            further: interface::further(&target, compiled, &about[..about.len().min(2)]),
            counts,
            warnings: compiled.warnings.clone(),
        }
    }

    /// The text of the header, `NAME.h`.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// The text of the source file, `NAME.c`, which includes the header by its name.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// All files: what each is called, and its text. Both, and behind them those of the [interface](Abi) that was asked for.
    pub fn files(&self) -> Vec<(String, &str)> {
        let own = [("h", self.header()), ("c", self.source())]
            .map(|(extension, text)| (format!("{}.{extension}", self.name), text));
        let further = self.further.iter();
        let further = further.map(|(name, text)| (name.clone(), text.as_str()));
        own.into_iter().chain(further).collect()
    }

    /// What the user should know of the arm; a sentence each.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The operations of each method of [`ulna::Arm`].
    pub fn counts(&self) -> &[(Method, Counts)] {
        &self.counts
    }
}

fn header_file(target: &Target<'_>, about: &[String], prototypes: &[String]) -> String {
    let scalar = match target.options.precision {
        Precision::Double => "double",
        Precision::Float => "float",
    };
    let joints = target.joints().len();
    let conventions = [
        format!("The arm {}: {joints} joints, unrolled.", target.model.name()),
        String::new(),
        "SI units and radians; of a prismatic joint read metres for radians and newtons for newton metres.".into(),
        "Twists and wrenches are linear first, [v; ω] and [f; n], in world axes, at the tool point.".into(),
        "q is measured from the table's configuration. A matrix is written by its columns, and what has several".into(),
        "parts one after another. For finite arguments no result is NaN: a prismatic joint farther out than 1000 m".into(),
        "is read as if it stood there, and where the task is singular, what has no value there is 0.".into(),
        "No function keeps anything between two calls. result must not overlap an argument.".into(),
    ];
    let content = format!(
        "\n{conventions}\n/* The scalar. */\ntypedef {scalar} {real};\n\n{prototypes}",
        conventions = comment(&conventions),
        real = target.real(),
        prototypes = prototypes.join("\n"),
    );
    interface::guarded(&target.own("h"), &comment(about), &content)
}

fn source_file(target: &Target<'_>, about: &[String], definitions: &[String]) -> String {
    let code = definitions.join("\n");
    let code = support::helpers(target, &code) + &code;
    let calls = |function: &str| code.contains(&format!("{}(", target.math(function)));
    let needed = [
        ("float.h", code.contains(target.largest())),
        ("math.h", ["sin", "cos", "sqrt"].into_iter().any(calls)),
        ("stdbool.h", code.contains("bool ")),
        ("stddef.h", code.contains("size_t")),
    ];
    let needed = needed.iter().filter(|(_, is_needed)| *is_needed);
    let needed: String = needed
        .map(|(header, _)| format!("#include <{header}>\n"))
        .collect();
    let name = target.model.name();
    format!(
        "{about}#include \"{name}.h\"\n\n{needed}\n{code}",
        about = comment(&about[..about.len().min(2)])
    )
}
