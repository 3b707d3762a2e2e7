//! A control cycle allocates nothing, whatever the law, the projector, the backend and the outcome; nor does the truth model.

use ulna::control::compensation::FreeTorque;
use ulna::control::failure::impact_torque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Arm, Compensation, Controller, Failure, JointLimits, JointState, LockedJoints, OnLine, Payload,
    PointToPoint, Projector, Recourse, Schedule, SerialChain, Status, SuppressionLaw,
    SuppressionLoop,
};
use ulna_generated::{Geared6, Ssrms};
use ulna_study::simulation::{Brake, Control, Feedback, Resolution, Simulation};
use ulna_table::Model;

fn allocations(work: impl FnOnce()) -> u64 {
    allocation_counter::measure(work).count_total
}

fn cycles(arm: &impl Arm<7>) {
    let wrench = Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
    let moving = JointState {
        q: SVector::from([0.7, -0.6, 1.3, -2.0, 0.3, 3.4, 0.0]),
        qd: SVector::repeat(0.01),
        qdd: SVector::repeat(0.02),
    };
    let broken = JointState {
        q: SVector::repeat(f64::NAN),
        ..moving
    };
    let k = SVector::repeat(1e8);
    let free = FreeTorque {
        torque: SVector::repeat(5.0),
        wrench,
    };
    let laws = [
        Compensation::PerJoint(k),
        Compensation::Projected(k),
        Compensation::Optimal {
            before: free,
            after: free,
        },
    ];
    let joint_2 = LockedJoints::new(&[1]).unwrap();
    let most = LockedJoints::new(&[0, 1, 2, 3, 4]).unwrap();
    let mut seen = Vec::new();
    for law in laws {
        for projector in [Projector::Static, Projector::DynamicallyConsistent] {
            for rated in [f64::INFINITY, 250.0, 1.0] {
                let controller = Controller::new(arm, law)
                    .with_projector(projector)
                    .with_rated_torque(SVector::repeat(rated));
                for locked in [LockedJoints::NONE, joint_2, most] {
                    for state in [moving, broken] {
                        let mut status = Status::Nominal;
                        let count = allocations(|| {
                            status = controller.cycle(&state, &wrench, locked).status;
                        });
                        assert_eq!(count, 0, "{status:?}");
                        seen.push(status);
                    }
                }
            }
        }
    }
    seen.sort();
    seen.dedup();
    assert_eq!(
        seen,
        [
            Status::Nominal,
            Status::Saturated,
            Status::NearSingular,
            Status::Overloaded,
            Status::NotFinite
        ]
    );
}

/// A loop through all it can meet: every law, a lock, another one, a switch, limits that bind, numbers that are none.
fn loops(arm: &impl Arm<7>, every: usize, rated: &[f64]) {
    let wrench = Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
    let k = SVector::repeat(1e7);
    let samples = [SVector::repeat(5.0), SVector::repeat(-3.0)];
    let laws = [
        SuppressionLaw::None,
        SuppressionLaw::Coefficients(Compensation::PerJoint(k)),
        SuppressionLaw::Schedule(Schedule::new(0.0, 0.05, &samples).unwrap()),
        SuppressionLaw::OnLine(OnLine::equal()),
    ];
    for law in laws {
        for rated in rated {
            let mut suppression = SuppressionLoop::new(arm, law, law)
                .with_recourse(Recourse::Nearest { force_budget: 1.0 })
                .with_ramp(0.02)
                .with_rate_limit(SVector::repeat(50.0))
                .with_rated_torque(SVector::repeat(*rated));
            let (mut limited, mut broken) = (0, 0);
            let count = allocations(|| {
                for i in (0..100).step_by(every) {
                    let time = 1e-3 * f64::from(i);
                    let state = JointState {
                        q: SVector::from([0.7, -0.6, 1.3, -2.0, 0.3, 3.4, 0.0]).add_scalar(time),
                        qd: SVector::repeat(if i == 60 { f64::NAN } else { 0.2 }),
                        qdd: SVector::repeat(0.02),
                    };
                    let set: &[usize] = match i {
                        ..30 => &[],
                        30..40 => &[1],
                        _ => &[1, 3],
                    };
                    if i == 80 {
                        suppression.switch(SuppressionLaw::OnLine(OnLine::equal()));
                    }
                    let locked = LockedJoints::new(set).unwrap();
                    let cycle = suppression.cycle(time, &state, &wrench, locked);
                    limited += u32::from(cycle.rate_limited);
                    broken += u32::from(cycle.control.status == Status::NotFinite);
                }
            });
            assert_eq!((count, broken), (0, 1));
            assert!(limited > 0);
        }
    }
}

#[test]
fn a_suppression_loop_allocates_nothing() {
    loops(&Ssrms, 1, &[f64::INFINITY, 250.0, 1.0]);
    loops(&Ssrms::CHAIN, 5, &[250.0]);
}

/// Another payload between two cycles: the loop goes on with the arm that carries it.
#[test]
fn a_change_of_payload_allocates_nothing() {
    let wrench = Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
    let state = JointState {
        q: SVector::from([0.7, 0.2, 1.3, -2.0, 0.3, 0.4]),
        qd: SVector::repeat(0.2),
        qdd: SVector::repeat(0.02),
    };
    let empty = Geared6::default();
    let mut arm = empty;
    let (mut before, mut after) = (SVector::zeros(), SVector::zeros());
    let count = allocations(|| {
        let mut suppression = SuppressionLoop::on_line(&empty, OnLine::equal());
        let free = LockedJoints::NONE;
        before = suppression.cycle(0.0, &state, &wrench, free).control.torque;
        let body = Payload::new(5.0, [0.1, 0.0, 0.2], [[0.0; 3]; 3]);
        assert!(body.and_then(|body| arm.set_payload(body)).is_ok());
        suppression.set_arm(&arm);
        after = suppression
            .cycle(1e-3, &state, &wrench, free)
            .control
            .torque;
    });
    assert_eq!(count, 0);
    assert!((after - before).amax() > 1.0);
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
}

#[test]
fn a_control_cycle_allocates_nothing_on_a_generated_arm() {
    cycles(&Ssrms);
}

#[test]
fn a_control_cycle_allocates_nothing_on_the_generic_path() {
    let chain = SerialChain::<7>::try_from(&Model::load("../arms/ssrms.toml").unwrap()).unwrap();
    cycles(&chain);
    let state = JointState {
        q: SVector::repeat(0.3),
        qd: SVector::repeat(0.1),
        qdd: SVector::repeat(0.02),
    };
    let locked = LockedJoints::new(&[1]).unwrap();
    let count = allocations(|| {
        std::hint::black_box(impact_torque(&chain, &state, locked, &Vector6::zeros()));
    });
    assert_eq!(count, 0);
}

#[test]
fn a_simulated_failure_allocates_nothing() {
    let start = SVector::from([0.7, -0.6, 1.3, -2.0, 0.3, 3.4, 0.0]);
    let goal = start + SVector::repeat(0.5);
    let motion = PointToPoint::new(start, goal, 4.0, 1.0, &JointLimits::none()).unwrap();
    let failure = Failure {
        joints: LockedJoints::new(&[1]).unwrap(),
        time: 2.0,
    };
    let mut samples = 0;
    for control in [Control::Continuous, Control::Every(2e-3)] {
        let simulation = Simulation {
            plant: &Ssrms,
            controller: Controller::new(&Ssrms, Compensation::PerJoint(SVector::repeat(1e6))),
            trajectory: &motion,
            wrench: |_| Vector6::zeros(),
            feedback: Feedback::critical(5.0),
            control,
            brake: Brake::new(failure, 0.01),
            reflected_inertia: SVector::zeros(),
        };
        let count = allocations(|| {
            let outcome = simulation.run(1.9..2.1, &Resolution::default(), |_| samples += 1);
            assert!(outcome.is_ok_and(|outcome| outcome.impact.is_some()));
        });
        assert_eq!(count, 0);
    }
    assert!(samples > 96);
}
