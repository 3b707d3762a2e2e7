//! [`Generator`]: which methods of an arm become code.

use std::fmt;
use std::path::Path;

use ulna::{Method, MethodSet};
use ulna_table::Model;
use ulna_table::toml_reader::closest;

use crate::{COptions, Compiled, Error, Generated, GeneratedC, Stage, build};

/// Generates code for every method of [`ulna::Arm`], or for some of them.
///
/// ```no_run
/// // build.rs
/// use ulna_codegen::Generator;
/// use ulna::Method;
///
/// fn main() -> Result<(), ulna_codegen::Error> {
///     Generator::new()
///         .methods(&[Method::MassMatrix, Method::InverseDynamics])
///         .compile_arms(&["arms/ssrms.toml"])
/// }
/// ```
///
/// The type implements [`ulna::Arm`] in full all the same. What is not generated takes no lines and no time to compile; it runs by
/// the textbook formulas of [`ulna::SerialChain`], and a batch of it state by state: the same numbers but for rounding, slower.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Generator {
    methods: MethodSet,
}

impl Default for Generator {
    fn default() -> Self {
        Self::new()
    }
}

impl Generator {
    /// Of every method.
    pub fn new() -> Self {
        Self {
            methods: MethodSet::ALL,
        }
    }

    /// Of those methods alone; [`Generator::method`] has one by its name.
    #[must_use]
    pub fn methods(self, methods: &[Method]) -> Self {
        Self {
            methods: MethodSet::of(methods),
        }
    }

    /// What it generates.
    pub fn chosen(&self) -> MethodSet {
        self.methods
    }

    /// The method of that name.
    ///
    /// # Errors
    /// A name that is none, told with the one that may be meant and all that there are.
    pub fn method(name: &str) -> Result<Method, UnknownMethod> {
        Method::by_name(name).ok_or_else(|| UnknownMethod {
            name: name.to_owned(),
        })
    }

    /// As [`generate`](crate::generate).
    pub fn generate(&self, model: &Model, source: &str) -> Generated {
        self.generate_watched(model, source, &|_| ())
    }

    /// The same, telling `watch` of every stage before it begins.
    pub fn generate_watched(
        &self,
        model: &Model,
        source: &str,
        watch: &dyn Fn(Stage),
    ) -> Generated {
        let compiled = self.compile_watched(model, watch);
        Generated::new(model, file_name(source), compiled, watch)
    }

    /// The arm in C: a header and a source file. `source` is the table's path, as for [`generate`](crate::generate).
    ///
    /// ```no_run
    /// use ulna_codegen::{COptions, Generator};
    /// let table = "arms/ssrms.toml";
    /// let c = Generator::new().generate_c(&ulna_table::Model::load(table)?, table, COptions::new());
    /// for (name, text) in c.files() {
    ///     std::fs::write(name, text)?; // ssrms.h, ssrms.c
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn generate_c(&self, model: &Model, source: &str, options: COptions) -> GeneratedC {
        self.generate_c_watched(model, source, options, &|_| ())
    }

    /// The same, telling `watch` of every stage before it begins.
    pub fn generate_c_watched(
        &self,
        model: &Model,
        source: &str,
        options: COptions,
        watch: &dyn Fn(Stage),
    ) -> GeneratedC {
        let compiled = self.compile_watched(model, watch);
        GeneratedC::watched(model, file_name(source), &compiled, options, watch)
    }

    /// As [`compile`](crate::compile).
    pub fn compile(&self, model: &Model) -> Compiled {
        self.compile_watched(model, &|_| ())
    }

    /// The same, telling `watch` of every stage before it begins.
    pub fn compile_watched(&self, model: &Model, watch: &dyn Fn(Stage)) -> Compiled {
        crate::compile_methods(model, self.methods, watch)
    }

    /// As [`compile_arms`](crate::compile_arms).
    ///
    /// # Errors
    /// As there.
    pub fn compile_arms(&self, tables: &[impl AsRef<Path>]) -> Result<(), Error> {
        build::compile_arms_with(self, tables)
    }

    /// As [`compile_listed`](crate::compile_listed).
    ///
    /// # Errors
    /// As there.
    pub fn compile_listed(&self, tables: &[impl AsRef<Path>]) -> Result<(), Error> {
        build::compile_listed_with(self, tables)
    }

    /// As [`compile_folder`](crate::compile_folder).
    ///
    /// # Errors
    /// As there.
    pub fn compile_folder(&self, folder: impl AsRef<Path>) -> Result<(), Error> {
        build::compile_folder_with(self, folder.as_ref())
    }
}

/// The last part of a path.
fn file_name(path: &str) -> &str {
    path.rsplit(std::path::is_separator).next().unwrap_or(path)
}

/// A name that no method of [`ulna::Arm`] has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownMethod {
    name: String,
}

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = || Method::ALL.iter().map(|method| method.name());
        write!(f, "unknown method `{}`", self.name.escape_debug())?;
        if let Some(meant) = closest(&self.name, names()) {
            write!(f, ": did you mean `{meant}`?")?;
        }
        let names: Vec<&str> = names().collect();
        write!(f, "\nthe methods are {}", names.join(", "))
    }
}

impl std::error::Error for UnknownMethod {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_method_is_told_with_what_is_meant_and_what_there_is() {
        let error = Generator::method("mass_matirx").unwrap_err().to_string();
        assert!(
            error.starts_with("unknown method `mass_matirx`: did you mean `mass_matrix`?\n"),
            "{error}"
        );
        for method in Method::ALL {
            assert_eq!(Generator::method(method.name()), Ok(*method));
            assert!(error.contains(method.name()));
        }
    }

    /// Nothing of a method's program depends on what else is generated.
    #[test]
    fn a_method_alone_is_what_it_is_among_all() {
        for arm in ["planar_2r", "ssrms", "oblique_6"] {
            let model = Model::load(format!("../arms/{arm}.toml")).unwrap();
            let all = Generator::new().compile(&model);
            assert_eq!(all.methods.len(), Method::ALL.len());
            for whole in &all.methods {
                let alone = Generator::new().methods(&[whole.method]).compile(&model);
                let [only] = alone.methods.as_slice() else {
                    panic!("{} programs", alone.methods.len());
                };
                assert_eq!(only.method, whole.method);
                assert_eq!(only.error.to_bits(), whole.error.to_bits());
                assert_eq!(only.program.steps, whole.program.steps, "{}", only.method);
                let rows = only.method.zero_where_singular();
                assert_eq!(alone.conditioned, rows.and(all.conditioned));
            }
        }
    }
}
