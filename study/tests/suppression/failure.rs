use ulna::control::failure::{impact_torque, impact_torque_of};
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, Failure, LockedJoints, SerialChain, Trajectory};

use crate::arms::{on_every_arm, paper_like_motion, ssrms, states};

/// Every joint alone, every pair, and all at once.
fn sets<const N: usize>() -> Vec<LockedJoints<N>> {
    let all: Vec<usize> = (0..N).collect();
    let pairs = (0..N).flat_map(|k| (k..N).map(move |l| vec![k, l]));
    pairs
        .chain([all])
        .map(|joints| LockedJoints::new(&joints).unwrap())
        .collect()
}

#[test]
fn recursion_is_the_difference_of_two_newton_euler_passes() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        // Without gravity, which drops out of the deviation and would only add rounding to the two passes.
        let chain = &SerialChain {
            gravity: [0.0; 3],
            ..*chain
        };
        for state in states(chain, 10) {
            for locked in sets() {
                let after = locked.hold(&state);
                let loads_before = chain.joint_loads(&state.q, &state.qd, &state.qdd);
                let loads_after = chain.joint_loads(&after.q, &after.qd, &after.qdd);
                let impact = impact_torque(chain, &state, locked, &Vector6::zeros());
                let scale = |load: &dyn Fn(usize) -> f64| (0..N).map(load).fold(0.0, f64::max);
                let force = scale(&|i| loads_before[i].force.norm());
                let moment = scale(&|i| loads_before[i].moment.norm());
                for i in 0..N {
                    let df = loads_before[i].force - loads_after[i].force - impact.loads[i].force;
                    let dn =
                        loads_before[i].moment - loads_after[i].moment - impact.loads[i].moment;
                    let error = (df.norm() / force).max(dn.norm() / moment);
                    assert!(
                        error < 1e-12,
                        "{name}: {locked:?}, joint {}: {error:e}",
                        i + 1
                    );
                }
                let by_calls = impact_torque_of(chain, &state, locked, &Vector6::zeros());
                let error = (by_calls - impact.torque).amax() / force.max(moment);
                assert!(error < 1e-12, "{name}: {locked:?}: {error:e}");
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn gravity_drops_out() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let weightless = SerialChain {
            gravity: [0.0; 3],
            ..*chain
        };
        let heavy = SerialChain {
            gravity: [1.0, -2.0, 9.81],
            ..*chain
        };
        for state in states(chain, 5) {
            for locked in sets() {
                let impact = |chain| impact_torque(chain, &state, locked, &Vector6::zeros());
                assert_eq!(impact(&weightless), impact(&heavy), "{name}");
                // Two passes see it in both calls, and lose only rounding.
                let by_calls = impact_torque_of(&heavy, &state, locked, &Vector6::zeros());
                let scale = heavy
                    .inverse_dynamics(&state.q, &state.qd, &state.qdd)
                    .amax();
                let error = (by_calls - impact(&heavy).torque).amax() / scale;
                assert!(error < 1e-12, "{name}: {error:e}");
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn a_varying_wrench_adds_its_static_torque() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let delta = Vector6::new(3.0, -1.0, 2.0, 0.5, 0.25, -0.75);
        for state in states(chain, 10) {
            for locked in [LockedJoints::NONE, LockedJoints::new(&[0]).unwrap()] {
                let steady = impact_torque(chain, &state, locked, &Vector6::zeros());
                let varying = impact_torque(chain, &state, locked, &delta);
                let by_jacobian = chain.geometric_jacobian(&state.q).tr_mul(&delta);
                let error = (varying.torque - steady.torque - by_jacobian).amax();
                assert!(error < 1e-12 * by_jacobian.amax(), "{name}: {error:e}");
                // The base feels the whole wrench.
                let moved = varying.loads[0].force - steady.loads[0].force;
                assert!((moved.norm() - 14.0_f64.sqrt()).abs() < 1e-12);
                let by_calls = impact_torque_of(chain, &state, locked, &delta);
                assert!((by_calls - varying.torque).amax() < 1e-10, "{name}");
            }
        }
    }
    on_every_arm!(check);
}

/// Of the same size as the paper's Table 2; the figures are those of an independent prototype.
#[test]
fn paper_like_impact_torque_at_3_10_and_18_s() {
    let arm = ssrms();
    let motion = paper_like_motion();
    let joint_2 = LockedJoints::new(&[1]).unwrap();
    let expected = [
        (3.0, [31.34, 33.02, 11.22, 0.425, 0.174, 1.049]),
        (10.0, [35.97, 61.95, 23.23, 1.237, 0.662, 1.574]),
        (18.0, [7.66, 54.81, 14.28, 0.339, 0.070, 0.574]),
    ];
    for (time, expected) in expected {
        let impact = impact_torque(&arm, &motion.state(time), joint_2, &Vector6::zeros());
        for (joint, expected) in expected.into_iter().enumerate() {
            let error = (impact.torque[joint].abs() - expected).abs() / expected;
            assert!(error < 5e-3, "joint {} at {time} s: {error:e}", joint + 1);
        }
        assert!(impact.torque[6].abs() < 5e-4);
    }
}

#[test]
fn a_locked_arm_has_no_columns_and_rows_of_its_locked_joints() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        for state in states(chain, 5) {
            for locked in sets() {
                let healthy: Vec<usize> = locked.healthy().collect();
                assert_eq!(healthy.len() + locked.len(), N);
                let m = chain.mass_matrix(&state.q);
                let reduced = locked.reduce_mass_matrix(&m);
                // The healthy block's inverse is the inverse's healthy block.
                let block = m.select_rows(&healthy).select_columns(&healthy);
                let inverse = reduced.cholesky().unwrap().inverse();
                let inverse = inverse.select_rows(&healthy).select_columns(&healthy);
                if !healthy.is_empty() {
                    let unit = &block * inverse;
                    let error = (unit
                        - ulna::nalgebra::DMatrix::identity(healthy.len(), healthy.len()))
                    .amax();
                    assert!(error < 1e-9, "{name}: {error:e}");
                }
                let j = chain.geometric_jacobian(&state.q);
                let twist = locked.reduce_jacobian(&j) * state.qd;
                assert!((twist - j * locked.without(&state.qd)).amax() < 1e-12);
            }
        }
    }
    on_every_arm!(check);
}

#[test]
fn a_set_of_joints_refuses_joints_that_are_not_there() {
    assert!(LockedJoints::<7>::new(&[7]).is_none());
    assert!(LockedJoints::<7>::new(&[0, 6]).is_some());
    let locked = LockedJoints::<7>::new(&[1, 4, 1]).unwrap();
    assert_eq!(locked.len(), 2);
    assert_eq!(locked.iter().collect::<Vec<_>>(), [1, 4]);
    assert_eq!(locked.healthy().collect::<Vec<_>>(), [0, 2, 3, 5, 6]);
    assert!(LockedJoints::<7>::NONE.is_empty() && !locked.contains(70));
}

#[test]
fn a_locked_joint_stays_where_it_was() {
    let motion = paper_like_motion();
    let failure = Failure {
        joints: LockedJoints::new(&[1]).unwrap(),
        time: 10.0,
    };
    assert_eq!(failure.state(&motion, 9.0), motion.state(9.0));
    let (planned, held) = (motion.state(12.0), failure.state(&motion, 12.0));
    assert_eq!(held.q[1], motion.state(10.0).q[1]);
    assert_eq!((held.qd[1], held.qdd[1]), (0.0, 0.0));
    let healthy = SVector::from([1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(
        held.q.component_mul(&healthy),
        planned.q.component_mul(&healthy)
    );
    assert_eq!(held.qd, planned.qd.component_mul(&healthy));
}
