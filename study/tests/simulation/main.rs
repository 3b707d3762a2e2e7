//! The truth model: an arm through a failure, and what must hold whatever happens to it.

mod balance;
mod brakes;
mod friction;
mod healthy_joints;
mod peaks;
mod rotors;
mod runs;

use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Arm, Compensation, Controller, Failure, JointLimits, LockedJoints, PointToPoint, SerialChain,
};
use ulna_generated::{Oblique6, Ssrms};
use ulna_study::simulation::{Brake, Control, Feedback, Simulation};

/// The paper-like motion of the SSRMS.
fn ssrms_motion() -> PointToPoint<7> {
    let start = SVector::from([0.0, 0.601, -0.895, -2.108, -1.398, 1.437, 0.0]);
    // As angles of the table's rows; q counts from the table's configuration.
    let row = SVector::from([0.0, 90.0, 0.0, 0.0, 0.0, -90.0, 0.0]).map(f64::to_radians);
    let travel = SVector::from([1.474, 0.689, -4.400, 0.273, -3.284, 0.820, 0.0]);
    let q = start - row;
    PointToPoint::new(q, q + travel, 20.0, 4.455, &JointLimits::none()).unwrap()
}

/// A motion of the oblique arm, its sliding joint included.
fn oblique_motion() -> PointToPoint<6> {
    let start = SVector::from([0.3, -0.5, 0.1, 0.8, -0.4, 0.2]);
    let travel = SVector::from([1.1, 0.7, 0.25, -1.3, 0.9, 2.0]);
    PointToPoint::new(start, start + travel, 3.0, 0.7, &JointLimits::none()).unwrap()
}

fn pushing(_: f64) -> Vector6<f64> {
    Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0)
}

/// Coefficients of Eq. 16 that cancel joint 2's lock at 10 s, to three digits.
fn cancelling() -> Compensation<7> {
    let k = [5.11e7, -8.07e7, 3.90e7, -3.75e7, 1.08e7, 0.78e7, 0.0];
    Compensation::PerJoint(SVector::from(k))
}

fn lock<const N: usize>(joints: &[usize], time: f64) -> Failure<N> {
    Failure {
        joints: LockedJoints::new(joints).unwrap(),
        time,
    }
}

type Failing<'a, A, const N: usize> =
    Simulation<'a, A, A, PointToPoint<N>, fn(f64) -> Vector6<f64>, N>;

/// Joint 2 of the SSRMS braked at 10 s for `duration`. Its motors have no limits: the motion alone asks for more than the rated torque.
fn ssrms(
    motion: &PointToPoint<7>,
    compensation: Compensation<7>,
    duration: f64,
) -> Failing<'_, Ssrms, 7> {
    Simulation {
        plant: &Ssrms,
        controller: Controller::new(&Ssrms, compensation)
            .with_rated_torque(SVector::repeat(f64::INFINITY)),
        trajectory: motion,
        wrench: pushing,
        feedback: Feedback::NONE,
        control: Control::Continuous,
        brake: Brake::new(lock(&[1], 10.0), duration),
        reflected_inertia: SVector::zeros(),
    }
}

/// Joint `joint` of the oblique arm under gravity braked at 1.2 s for `duration`.
fn oblique(motion: &PointToPoint<6>, joint: usize, duration: f64) -> Failing<'_, Oblique6, 6> {
    Simulation {
        plant: &Oblique6,
        controller: Controller::new(&Oblique6, Compensation::none())
            .with_rated_torque(SVector::repeat(f64::INFINITY)),
        trajectory: motion,
        wrench: pushing,
        feedback: Feedback::critical(8.0),
        control: Control::Continuous,
        brake: Brake::new(lock(&[joint], 1.2), duration),
        reflected_inertia: SVector::zeros(),
    }
}

/// −Σ m g·c over the links, from the frames alone.
fn potential_energy<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> f64 {
    let gravity = SVector::from(chain.gravity);
    let frames = chain.link_frames(q);
    let energy = |(frame, joint): (&ulna::nalgebra::IsometryMatrix3<f64>, &ulna::Joint)| {
        let com = frame * ulna::nalgebra::Point3::from(joint.link.com);
        -joint.link.mass * gravity.dot(&com.coords)
    };
    frames.iter().zip(&chain.joints).map(energy).sum()
}

/// −q̇_k / (M⁻¹)_kk, with the inverse spelt out.
fn ideal_impulse<const N: usize>(
    arm: &impl Arm<N>,
    q: &SVector<f64, N>,
    qd: &SVector<f64, N>,
    joint: usize,
) -> f64 {
    let inverse = arm.mass_matrix(q).try_inverse().unwrap();
    -qd[joint] / inverse[(joint, joint)]
}
