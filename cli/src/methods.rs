//! The option `--methods`: which methods are generated.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use ulna::Method;
use ulna_codegen::Generator;

/// Which methods of the trait Arm are generated.
#[derive(Args)]
pub(crate) struct Methods {
    /// Generate these methods of the trait Arm alone, separated by commas; the others run by the textbook formulas
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_possible_values = true, value_parser = by_name())]
    methods: Vec<Method>,
}

fn by_name() -> impl TypedValueParser<Value = Method> {
    let names = Method::ALL.iter().map(|method| method.name());
    PossibleValuesParser::new(names).try_map(|name| Generator::method(&name))
}

impl Methods {
    /// What generates them.
    pub(crate) fn generator(&self) -> Generator {
        if self.methods.is_empty() {
            Generator::new()
        } else {
            Generator::new().methods(&self.methods)
        }
    }

    /// The option as it was given, with a space before it; empty if it was not.
    pub(crate) fn option(&self) -> String {
        if self.methods.is_empty() {
            return String::new();
        }
        let names: Vec<&str> = self.methods.iter().map(|method| method.name()).collect();
        format!(" --methods {}", names.join(","))
    }

    /// The names of what is not generated, separated by commas; `None` if everything is.
    pub(crate) fn absent(&self) -> Option<String> {
        let absent = self.generator().chosen().rest();
        let names: Vec<&str> = absent.iter().map(Method::name).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }
}
