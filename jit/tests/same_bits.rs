//! Machine code made at run time computes what the compiler's code computes, to the last bit.

use ulna::internal::numbers;
use ulna::proof::{State, states};
use ulna::{Arm, Method, SerialChain};
use ulna_jit::Jit;
use ulna_table::Model;

fn bits<A: Arm<N>, const N: usize>(arm: &A, method: Method, state: &State<N>) -> Vec<u64> {
    let mut bits = Vec::new();
    // Of a zero the sign is free.
    numbers(arm, method, state, |number| {
        bits.push((number + 0.0).to_bits());
    });
    bits
}

fn compare<const N: usize>(name: &str, generated: &impl Arm<N>, chain: &SerialChain<N>) {
    let model = Model::load(format!("../arms/{name}.toml")).unwrap();
    let jit = Jit::<N>::compile(&model).unwrap();
    let far = states(chain).take(2).map(|state| State {
        q: state.q * 1e5,
        ..state
    });
    for state in states(chain).take(8).chain(far).chain([State::default()]) {
        for method in Method::ALL {
            assert_eq!(
                bits(&jit, *method, &state),
                bits(generated, *method, &state),
                "{name}: {method} at {state:?}"
            );
        }
    }
}

macro_rules! compare_each {
    ($(($Type:ident, $name:ident, $joints:literal))*) => {
        $(
            #[test]
            fn $name() {
                compare::<$joints>(
                    stringify!($name),
                    &ulna_generated::$Type::default(),
                    &ulna_generated::$Type::CHAIN,
                );
            }
        )*
    };
}
ulna_generated::for_each_arm!(compare_each);
