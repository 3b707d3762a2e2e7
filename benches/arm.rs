//! Every method of [`Arm`] that computes something, generated against generic, for every arm of `arms/`.
//!
//! `cargo bench --bench arm`, then `benches/ratios.py` for the table.
//! `-- ssrms/` or `-- mass_matrix` picks an arm or a method.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use ulna::proof::{State, states};
use ulna::{Arm, SerialChain};

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;

type Method<A, const N: usize> = (&'static str, fn(&A, &State<N>));

/// The methods of a backend, each as a call with its arguments from a state.
fn methods<A: Arm<N>, const N: usize>(_: &A) -> [Method<A, N>; 13] {
    macro_rules! methods {
        ($($name:ident($($argument:ident),*))*) => {
            [$((stringify!($name), |arm, state| {
                black_box(arm.$name($(&state.$argument),*));
            })),*]
        };
    }
    methods! {
        forward_kinematics(q)
        geometric_jacobian(q)
        jacobian_derivatives(q)
        mass_matrix(q)
        mass_matrix_derivatives(q)
        mass_matrix_and_derivatives(q)
        dynamic_manipulability(q)
        dynamic_manipulability_gradient(q)
        jacobian_and_gradient(q)
        inverse_dynamics(q, qd, qdd)
        bias_force(q, qd)
        gravity_torque(q)
        forward_dynamics(q, qd, tau)
    }
}

fn time<A: Arm<N>, const N: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    backend: &str,
    arm: &A,
    (_, method): Method<A, N>,
    states: &[State<N>],
) {
    group.bench_function(backend, |bencher| {
        let mut states = states.iter().cycle();
        bencher.iter(|| {
            if let Some(state) = states.next() {
                method(arm, state);
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
    for (fast, reference) in methods(generated).into_iter().zip(methods(generic)) {
        let mut group = criterion.benchmark_group(format!("{name}/{}", fast.0));
        time(&mut group, "generated", generated, fast, &states);
        time(&mut group, "generic", generic, reference, &states);
        group.finish();
    }
}

fn arms(criterion: &mut Criterion) {
    macro_rules! compare_each {
        ($(($arm:ident, $name:ident, $joints:literal))*) => {
            $(compare::<$joints>(
                criterion,
                stringify!($name),
                &ulna_generated::$arm,
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
