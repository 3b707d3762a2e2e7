//! One control cycle on the SSRMS (torque, compensation, margins) with joint 2 locked, and the part of it that is generated code.
//!
//! `cargo bench --bench cycle`, then `benches/ratios.py` for the shares.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use ulna::control::compensation::FreeTorque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::proof::states;
use ulna::{Arm, Compensation, Controller, JointState, LockedJoints, Projector};
use ulna_generated::Ssrms;

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;

fn cycle(criterion: &mut Criterion) {
    let states: Vec<JointState<7>> = states(&Ssrms::CHAIN)
        .take(STATES)
        .map(|state| JointState {
            q: state.q,
            qd: state.qd * 0.1,
            qdd: state.qdd * 0.1,
        })
        .collect();
    let wrench = Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
    let locked = LockedJoints::new(&[1]).unwrap_or(LockedJoints::NONE);
    let coefficients = SVector::repeat(1e7);
    let free = FreeTorque {
        torque: SVector::repeat(5.0),
        wrench,
    };

    let mut group = criterion.benchmark_group("ssrms/cycle");
    let mut time = |name: &str, work: &dyn Fn(&JointState<7>)| {
        group.bench_function(name, |bencher| {
            let mut states = states.iter().cycle();
            bencher.iter(|| {
                if let Some(state) = states.next() {
                    work(state);
                }
            });
        });
    };

    time("generated_part", &|state| {
        let held = locked.hold(state);
        black_box(Ssrms.jacobian_and_gradient(&held.q));
        black_box(Ssrms.inverse_dynamics(&held.q, &held.qd, &held.qdd));
    });
    for (name, compensation) in [
        ("per_joint", Compensation::PerJoint(coefficients)),
        ("projected", Compensation::Projected(coefficients)),
        (
            "optimal",
            Compensation::Optimal {
                before: free,
                after: free,
            },
        ),
    ] {
        let controller = Controller::new(&Ssrms, compensation);
        time(name, &|state| {
            black_box(controller.cycle(state, &wrench, locked));
        });
    }
    let consistent = Controller::new(&Ssrms, Compensation::PerJoint(coefficients))
        .with_projector(Projector::DynamicallyConsistent);
    time("dynamically_consistent", &|state| {
        black_box(consistent.cycle(state, &wrench, locked));
    });
    let generic = Controller::new(&Ssrms::CHAIN, Compensation::PerJoint(coefficients));
    time("generic", &|state| {
        black_box(generic.cycle(state, &wrench, locked));
    });
    group.finish();
}

fn brief() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .without_plots()
}

criterion_group! { name = benches; config = brief(); targets = cycle }
criterion_main!(benches);
