//! Every method of [`Arm`] that computes something, generated against generic, for every arm of `arms/`.
//!
//! `cargo bench --bench arm`, then `benches/ratios.py` for the table.
//! `-- ssrms/` or `-- mass_matrix` picks an arm or a method.

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use ulna::internal::call;
use ulna::proof::{State, states};
use ulna::{Arm, Method, SerialChain};

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;

fn time<A: Arm<N>, const N: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    backend: &str,
    arm: &A,
    method: Method,
    states: &[State<N>],
) {
    let call = call(method);
    group.bench_function(backend, |bencher| {
        let mut states = states.iter().cycle();
        bencher.iter(|| {
            if let Some(state) = states.next() {
                call(arm, state);
            }
        });
    });
}

/// Both backends of an arm side by side, method by method.
fn compare<const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    generated: &impl Arm<N>,
    generic: &SerialChain<N>,
) {
    let states: Vec<State<N>> = states(generic).take(STATES).collect();
    for method in Method::ALL {
        let mut group = criterion.benchmark_group(format!("{name}/{method}"));
        time(&mut group, "generated", generated, *method, &states);
        time(&mut group, "generic", generic, *method, &states);
        group.finish();
    }
}

fn arms(criterion: &mut Criterion) {
    macro_rules! compare_each {
        ($(($arm:ident, $name:ident, $joints:literal))*) => {
            $(compare::<$joints>(
                criterion,
                stringify!($name),
                &ulna_generated::$arm::default(),
                &ulna_generated::$arm::CHAIN,
            );)*
        };
    }
    ulna_generated::for_each_arm!(compare_each);
}

fn brief() -> Criterion {
    Criterion::default()
        .sample_size(30)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(400))
        .without_plots()
}

criterion_group! { name = benches; config = brief(); targets = arms }
criterion_main!(benches);
