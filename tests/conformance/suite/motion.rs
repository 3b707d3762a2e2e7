//! Links one by one, J's rate, and energies.

use nalgebra::{Isometry3, SMatrix, SVector, Translation3, UnitQuaternion, Vector3};
use ulna::proof::State;
use ulna::{Arm, Placement, SerialChain};

use super::differences::derivative;
use super::exponentials::Exponentials;
use super::{at_states, near};

fn isometry(placement: &Placement) -> Isometry3<f64> {
    let rotation = SMatrix::<f64, 3, 3>::from_fn(|r, c| placement.rotation[r][c]);
    Isometry3::from_parts(
        Translation3::from(Vector3::from(placement.translation)),
        UnitQuaternion::from_matrix(&rotation),
    )
}

pub(crate) fn the_last_link_carries_the_tool<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let tool = isometry(&chain.tool).to_homogeneous();
    at_states(chain, |State { q, .. }| {
        let last = arm.link_poses(&q)[N - 1];
        let expected = arm.forward_kinematics(&q).to_homogeneous();
        let actual = last.to_homogeneous() * tool;
        near(&actual, &expected, 1.0, 1e-13, "pose of the tool");

        let arm_of_tool = last.rotation * Vector3::from(chain.tool.translation);
        let mut shifted = arm.link_jacobians(&q)[N - 1];
        for mut column in shifted.column_iter_mut() {
            let spin = Vector3::new(column[3], column[4], column[5]);
            let mut linear = column.fixed_rows_mut::<3>(0);
            linear += spin.cross(&arm_of_tool);
        }
        near(&shifted, &arm.geometric_jacobian(&q), 1.0, 1e-13, "J");
    });
}

pub(crate) fn link_jacobians_are_the_derivatives_of_link_poses<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let (here, jacobians) = (arm.link_poses(&q), arm.link_jacobians(&q));
        for link in 0..N {
            let columns = derivative(&q, 0.05, |q| {
                let pose = arm.link_poses(q)[link];
                let turned = pose.rotation.matrix() * here[link].rotation.matrix().transpose();
                let skew = (turned - turned.transpose()) * 0.5;
                let p = pose.translation.vector;
                SVector::<f64, 6>::new(p.x, p.y, p.z, skew.m32, skew.m13, skew.m21)
            });
            let expected = SMatrix::<f64, 6, N>::from_columns(&columns);
            near(&jacobians[link], &expected, 1.0, 1e-11, "J of a link");
        }
    });
}

pub(crate) fn the_centre_of_mass_is_the_mean_of_the_links<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let (mut mass, mut moment) = (0.0, Vector3::zeros());
        for (pose, joint) in arm.link_poses(&q).iter().zip(&chain.joints) {
            let com = pose.translation.vector + pose.rotation * Vector3::from(joint.link.com);
            mass += joint.link.mass;
            moment += com * joint.link.mass;
        }
        near(
            &arm.center_of_mass(&q),
            &(moment / mass),
            1.0,
            1e-13,
            "centre of mass",
        );
        let weight = moment.dot(&Vector3::from(chain.gravity));
        let scale = mass * Vector3::from(chain.gravity).norm();
        near(
            [&arm.potential_energy(&q)],
            [&-weight],
            scale,
            1e-13,
            "potential energy",
        );
    });
}

pub(crate) fn rates_follow_from_the_jacobians_derivatives<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, .. }| {
        let slopes = arm.jacobian_derivatives(&q);
        let expected: SMatrix<f64, 6, N> = (0..N).map(|i| slopes[i] * qd[i]).sum();
        near(
            &arm.jacobian_rate(&q, &qd),
            &expected,
            1.0,
            1e-13,
            "rate of J",
        );
        let acceleration = arm.bias_acceleration(&q, &qd);
        near(
            &acceleration,
            &(expected * qd),
            1.0,
            1e-13,
            "bias acceleration",
        );
    });
}

/// d/dt (T + U) = q̇ᵀ τ along the motion that τ makes, friction apart, and T = ½ q̇ᵀ M q̇.
pub(crate) fn torques_do_the_work_that_energy_gains<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, qd, qdd, .. }| {
        let expected = 0.5 * qd.dot(&(arm.mass_matrix(&q) * qd));
        near(
            [&arm.kinetic_energy(&q, &qd)],
            [&expected],
            0.0,
            1e-12,
            "kinetic energy",
        );
        let there = SVector::zeros();
        let difference = arm.potential_energy(&q) - arm.potential_energy(&there);
        let expected = exponentials.potential(&q) - exponentials.potential(&there);
        near([&difference], [&expected], 1.0, 1e-12, "potential energy");

        let energy = |t: &SVector<f64, 1>| {
            let t = t[0];
            let (q, qd) = (q + qd * t + qdd * (0.5 * t * t), qd + qdd * t);
            SVector::<f64, 1>::new(arm.kinetic_energy(&q, &qd) + arm.potential_energy(&q))
        };
        let [gain] = derivative(&SVector::<f64, 1>::zeros(), 0.02, energy);
        // Friction takes power, and no energy gains it.
        let torque = arm.inverse_dynamics(&q, &qd, &qdd) - arm.friction_torque(&qd);
        let scale = torque.abs().dot(&qd.abs());
        near(&gain, [&qd.dot(&torque)], scale, 1e-9, "power");
    });
}
