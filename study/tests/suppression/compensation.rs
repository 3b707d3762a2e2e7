use ulna::control::compensation::{FreeTorque, TaskPose};
use ulna::control::null_space::NEAR_SINGULAR;
use ulna::nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector6};
use ulna::{
    Arm, Compensation, Controller, JointState, LockedJoints, Projector, SerialChain, Status,
};

use crate::arms::{on_every_arm, paper_force, paper_like_motion, ssrms, states};
use ulna::Trajectory;

/// The second road: a dense pseudoinverse by singular value decomposition, for the task's rows and the healthy joints.
struct Dense {
    jacobian: DMatrix<f64>,
    inverse: DMatrix<f64>,
}

impl Dense {
    fn new<const N: usize>(
        chain: &SerialChain<N>,
        q: &SVector<f64, N>,
        locked: LockedJoints<N>,
    ) -> Self {
        let rows: Vec<usize> = chain.task.iter().map(ulna::TaskRow::index).collect();
        let mut jacobian = DMatrix::from_fn(rows.len(), N, |i, j| {
            chain.geometric_jacobian(q)[(rows[i], j)]
        });
        for joint in locked.iter() {
            jacobian.column_mut(joint).fill(0.0);
        }
        let inverse = jacobian.clone().pseudo_inverse(1e-9).unwrap();
        Self { jacobian, inverse }
    }

    fn conditioning(&self) -> f64 {
        let values = self.jacobian.singular_values();
        values.min() / values.max()
    }

    fn project(&self, x: &DVector<f64>) -> DVector<f64> {
        x - &self.inverse * (&self.jacobian * x)
    }

    fn static_wrench(&self, torque: &DVector<f64>) -> DVector<f64> {
        self.inverse.transpose() * torque
    }
}

fn dynamic<const N: usize>(vector: &SVector<f64, N>) -> DVector<f64> {
    DVector::from_column_slice(vector.as_slice())
}

/// Rows of a wrench that belong to the task.
fn task_part<const N: usize>(chain: &SerialChain<N>, wrench: &Vector6<f64>) -> DVector<f64> {
    let rows: Vec<usize> = chain.task.iter().map(ulna::TaskRow::index).collect();
    DVector::from_fn(rows.len(), |i, _| wrench[rows[i]])
}

/// Coefficients that make the compensation some tens of N·m, whatever the size of ∇w_D.
fn coefficients<const N: usize>(chain: &SerialChain<N>, state: &JointState<N>) -> SVector<f64, N> {
    let (_, gradient) = chain.dynamic_manipulability_gradient(&state.q);
    SVector::from_fn(|i, _| 10.0 * (1.0 + i as f64) / gradient.amax().max(1e-12))
}

fn first_joint_and_none<const N: usize>() -> [LockedJoints<N>; 2] {
    [LockedJoints::NONE, LockedJoints::new(&[0]).unwrap()]
}

#[test]
fn each_law_is_its_equation() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        for state in states(chain, 6) {
            for locked in first_joint_and_none() {
                let dense = Dense::new(chain, &state.q, locked);
                if dense.conditioning() < 5.0 * NEAR_SINGULAR {
                    continue;
                }
                let pose = TaskPose::new(chain, &state.q, locked, Projector::Static);
                assert!(pose.null_space.conditioning() > NEAR_SINGULAR, "{name}");
                let k = coefficients(chain, &state);
                let (_, gradient) = chain.dynamic_manipulability_gradient(&state.q);
                let gradient = dynamic(&locked.without(&gradient));
                let free = FreeTorque {
                    torque: k * 1e-3,
                    wrench: Vector6::new(1.0, -2.0, 3.0, 0.5, -0.4, 0.3),
                };
                let lifted = dense.jacobian.tr_mul(&task_part(chain, &free.wrench));
                let expected = [
                    (
                        Compensation::PerJoint(k),
                        dense.project(&gradient).component_mul(&dynamic(&k)),
                    ),
                    (
                        Compensation::Projected(k),
                        dense.project(&gradient.component_mul(&dynamic(&k))),
                    ),
                    (
                        Compensation::Optimal {
                            before: free,
                            after: free,
                        },
                        dense.project(&dynamic(&locked.without(&free.torque))) + lifted,
                    ),
                ];
                for (law, expected) in expected {
                    let found = pose.compensation(&law);
                    let error = (dynamic(&found) - &expected).amax() / expected.amax().max(1.0);
                    assert!(error < 1e-10, "{name}: {:?}: {error:e}", law.law());
                    for joint in locked.iter() {
                        assert_eq!(found[joint], 0.0, "{name}: {:?}", law.law());
                    }
                }
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn a_cycle_adds_up_and_reports_the_force_error() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let wrench = Vector6::new(2.0, -3.0, 1.0, 0.5, 0.2, -0.1);
        for state in states(chain, 6) {
            let controller =
                Controller::new(chain, Compensation::PerJoint(coefficients(chain, &state)))
                    .with_rated_torque(SVector::repeat(1e6));
            for locked in first_joint_and_none() {
                let dense = Dense::new(chain, &state.q, locked);
                if dense.conditioning() < 5.0 * NEAR_SINGULAR {
                    continue;
                }
                let cycle = controller.cycle(&state, &wrench, locked);
                assert_eq!(cycle.status, Status::Nominal, "{name}");
                let planned = chain.inverse_dynamics(
                    &state.q,
                    &locked.without(&state.qd),
                    &locked.without(&state.qdd),
                ) + chain.geometric_jacobian(&state.q).tr_mul(&wrench);
                assert_eq!(cycle.planned, planned);
                assert!(
                    (cycle.torque - planned - cycle.compensation).amax() < 1e-12 * planned.amax()
                );
                assert_eq!(cycle.margins, SVector::repeat(1e6) - cycle.torque.abs());
                let expected = dense.static_wrench(&dynamic(&cycle.compensation));
                let error = (task_part(chain, &cycle.force_error) - &expected).amax();
                assert!(error < 1e-9 * expected.amax().max(1.0), "{name}: {error:e}");
                // What a locked joint is said to do does not count.
                let mut other = state;
                for joint in locked.iter() {
                    other.qd[joint] = 7.0;
                    other.qdd[joint] = -9.0;
                }
                assert_eq!(controller.cycle(&other, &wrench, locked), cycle, "{name}");
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn inside_the_projector_the_tool_force_stays() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        for state in states(chain, 10) {
            let k = coefficients(chain, &state);
            let controller = Controller::new(chain, Compensation::Projected(k))
                .with_rated_torque(SVector::repeat(f64::INFINITY));
            for locked in first_joint_and_none() {
                let cycle = controller.cycle(&state, &Vector6::zeros(), locked);
                let size = cycle.compensation.amax().max(1.0);
                assert!(
                    cycle.force_error.amax() < 1e-9 * size,
                    "{name}: {:e}",
                    cycle.force_error.amax()
                );
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn the_dynamically_consistent_projector_leaves_the_tool_unaccelerated() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        for state in states(chain, 6) {
            for locked in first_joint_and_none() {
                let pose = TaskPose::new(chain, &state.q, locked, Projector::DynamicallyConsistent);
                if pose.null_space.conditioning() < 5.0 * NEAR_SINGULAR {
                    continue;
                }
                let x = SVector::from_fn(|i, _| 10.0 - 3.0 * i as f64);
                let torque = pose.project(&x);
                let m = locked.reduce_mass_matrix(&chain.mass_matrix(&state.q));
                let acceleration = m.cholesky().unwrap().solve(&torque);
                let tool = locked.reduce_jacobian(&pose.jacobian) * acceleration;
                let tool = task_part(chain, &tool).amax();
                assert!(
                    tool < 1e-9 * acceleration.amax().max(1.0),
                    "{name}: {tool:e}"
                );
                // A projector: once more changes nothing.
                let error = (pose.project(&torque) - torque).amax();
                assert!(error < 1e-9 * torque.amax().max(1.0), "{name}: {error:e}");
                for joint in locked.iter() {
                    assert_eq!(torque[joint], 0.0);
                }
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn rated_torques_hold_and_each_law_is_cut_in_its_own_way() {
    let arm = ssrms();
    let state = paper_like_motion().state(10.0);
    let k = SVector::from([5e7, 8e7, 4e7, 4e7, 1e7, 1e7, 0.0]);
    let free = Controller::new(&arm, Compensation::none())
        .with_rated_torque(SVector::repeat(f64::INFINITY))
        .cycle(&state, &paper_force(), LockedJoints::NONE);
    let rated = free.planned.abs() + SVector::repeat(5.0);
    for law in [Compensation::PerJoint(k), Compensation::Projected(k)] {
        let unlimited = Controller::new(&arm, law)
            .with_rated_torque(SVector::repeat(f64::INFINITY))
            .cycle(&state, &paper_force(), LockedJoints::NONE);
        assert_eq!(unlimited.status, Status::Nominal);
        let cycle = Controller::new(&arm, law).with_rated_torque(rated).cycle(
            &state,
            &paper_force(),
            LockedJoints::NONE,
        );
        assert_eq!(cycle.status, Status::Saturated);
        assert!(cycle.margins.min() >= -1e-12, "{}", cycle.margins);
        assert!(cycle.margins.min() < 1e-9);
        match law {
            Compensation::PerJoint(_) => {
                for i in 0..7 {
                    let wanted = unlimited.torque[i].clamp(-rated[i], rated[i]);
                    assert_eq!(cycle.torque[i], wanted);
                }
            }
            _ => {
                let scale = cycle.compensation.norm() / unlimited.compensation.norm();
                let error = (cycle.compensation - unlimited.compensation * scale).amax();
                assert!(scale < 1.0 && error < 1e-10, "{error:e}");
                assert!(cycle.force_error.amax() < 1e-10);
            }
        }
    }
    // The motion alone is too much for joint 4.
    let mut weak = rated;
    weak[3] = free.planned[3].abs() - 1.0;
    let cycle = Controller::new(&arm, Compensation::Projected(k))
        .with_rated_torque(weak)
        .cycle(&state, &paper_force(), LockedJoints::NONE);
    assert_eq!(cycle.status, Status::Overloaded);
    assert!(cycle.margins.min() >= 0.0);
    assert!(cycle.force_error.amax() > 1e-3);
    // A brake takes what comes.
    let joint_4 = LockedJoints::new(&[3]).unwrap();
    let braked = Controller::new(&arm, Compensation::none())
        .with_rated_torque(weak)
        .cycle(&state, &paper_force(), joint_4);
    assert_eq!(braked.torque[3], braked.planned[3]);
}

#[test]
fn what_is_no_number_is_a_status() {
    let arm = ssrms();
    let controller = Controller::new(&arm, Compensation::Projected(SVector::repeat(1e7)));
    let good = paper_like_motion().state(10.0);
    let cycle = |state, wrench| controller.cycle(&state, &wrench, LockedJoints::NONE);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut states = [good; 3];
        states[0].q[2] = bad;
        states[1].qd[4] = bad;
        states[2].qdd[6] = bad;
        for state in states {
            let cycle = cycle(state, paper_force());
            assert_eq!(cycle.status, Status::NotFinite);
            assert_eq!(cycle.torque, SVector::<f64, 7>::zeros());
        }
        assert_eq!(cycle(good, Vector6::repeat(bad)).status, Status::NotFinite);
    }
    let huge = JointState {
        qd: SVector::repeat(1e200),
        ..good
    };
    assert_eq!(cycle(huge, paper_force()).status, Status::NotFinite);
    let unrated =
        Controller::new(&arm, Compensation::none()).with_rated_torque(SVector::repeat(f64::NAN));
    let cycle = unrated.cycle(&good, &paper_force(), LockedJoints::NONE);
    assert_eq!(cycle.status, Status::Overloaded);
    assert_eq!(cycle.torque, SVector::<f64, 7>::zeros());
}

/// `J̃ = (Jᵀ)†` makes the paper's projector `I − J̃†J̃` the one on the null space of J.
#[test]
fn the_papers_projector_is_that_of_the_null_space() {
    let arm = ssrms();
    let state = paper_like_motion().state(5.0);
    let rows = arm
        .geometric_jacobian(&state.q)
        .fixed_rows::<3>(0)
        .into_owned();
    let dual = rows.transpose().pseudo_inverse(1e-12).unwrap();
    let papers: SMatrix<f64, 7, 7> =
        SMatrix::identity() - dual.pseudo_inverse(1e-12).unwrap() * dual;
    let pose = TaskPose::new(&arm, &state.q, LockedJoints::NONE, Projector::Static);
    for i in 0..7 {
        let axis = SVector::from_fn(|j, _| f64::from(u8::from(i == j)));
        assert!((pose.project(&axis) - papers * axis).amax() < 1e-12);
    }
}
