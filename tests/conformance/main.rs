//! One suite, every arm of `arms/` by the textbook and by its interpreted programs, and every arm that is compiled as generated code.

mod geared;
mod paper;
mod singular;
mod suite;

use ulna::SerialChain;
use ulna_table::Model;

include!(concat!(env!("OUT_DIR"), "/tables.rs"));

macro_rules! of_tables {
    ($(($name:ident, $n:literal))*) => {
        /// The generic path, from the table.
        mod generic {
            $(mod $name {
                crate::suite::conformance!(
                    crate::chain::<$n>(stringify!($name)),
                    crate::chain::<$n>(stringify!($name))
                );
            })*
        }

        /// The generator's programs, interpreted.
        mod interpreted {
            $(mod $name {
                use std::sync::OnceLock;

                use ulna_codegen::Interpreter;

                fn arm() -> &'static Interpreter<$n> {
                    static ARM: OnceLock<Interpreter<$n>> = OnceLock::new();
                    ARM.get_or_init(|| {
                        Interpreter::new(&crate::model(stringify!($name)))
                            .unwrap_or_else(|error| panic!("{error}"))
                    })
                }

                crate::suite::conformance!(*arm(), crate::chain::<$n>(stringify!($name)));
            })*
        }
    };
}
for_each_table!(of_tables);

macro_rules! compiled {
    ($(($Type:ident, $name:ident, $n:literal))*) => {
        /// Generated code, of the arms that are compiled: with the feature `all-arms` every one.
        mod generated {
            $(mod $name {
                crate::suite::conformance!(
                    ulna_generated::$Type::default(),
                    crate::chain::<$n>(stringify!($name))
                );

                #[test]
                fn carries_the_chain_of_its_table() {
                    let chain = crate::chain::<$n>(stringify!($name));
                    assert_eq!(ulna_generated::$Type::CHAIN, chain);
                }
            })*
        }
    };
}
ulna_generated::for_each_arm!(compiled);

fn model(name: &str) -> Model {
    let path = format!("{}/../arms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::load(path).unwrap_or_else(|errors| panic!("{errors}"))
}

fn chain<const N: usize>(name: &str) -> SerialChain<N> {
    SerialChain::try_from(&model(name)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn another_number_of_joints_is_refused() {
    let error = SerialChain::<6>::try_from(&model("ssrms")).expect_err("seven joints are not six");
    assert_eq!(
        error.to_string(),
        "arm `ssrms` has 7 joints, not 6: write SerialChain::<7>"
    );
}
