//! One control cycle on the SSRMS (torque, compensation, margins) with joint 2 locked, and the part of it that is generated code;
//! the on-line law and the loop with a memory, all joints still moving, which is the most there is to do.
//!
//! `cargo bench --bench cycle`, then `benches/ratios.py` for the shares.

use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use ulna::control::compensation::{FreeTorque, TaskPose};
use ulna::nalgebra::{SVector, Vector6};
use ulna::proof::states;
use ulna::{
    Arm, Compensation, Controller, JointState, LockedJoints, OnLine, Projector, Recourse,
    SuppressionLaw, SuppressionLoop,
};
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
    // The law alone: what it adds to a cycle.
    let law = OnLine::equal();
    time("on_line_law", &|state| {
        let pose = TaskPose::new(&Ssrms, &state.q, LockedJoints::NONE, Projector::Static);
        black_box(law.compensation(&Ssrms, state, &pose, LockedJoints::NONE));
    });
    for (name, before) in [
        ("loop_on_line", SuppressionLaw::OnLine(law)),
        (
            "loop_projected",
            SuppressionLaw::Coefficients(Compensation::Projected(coefficients)),
        ),
    ] {
        let suppression = RefCell::new(
            SuppressionLoop::new(&Ssrms, before, before)
                .with_rate_limit(SVector::repeat(1e3))
                .with_recourse(Recourse::Nearest { force_budget: 1.0 }),
        );
        let time_of = Cell::new(0.0);
        time(name, &|state| {
            time_of.set(time_of.get() + 1e-3);
            let mut suppression = suppression.borrow_mut();
            black_box(suppression.cycle(time_of.get(), state, &wrench, LockedJoints::NONE));
        });
    }
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
