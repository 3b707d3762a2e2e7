//! What a torque that is static for the tool does to it in motion.

use nalgebra::{Cholesky, SMatrix, SVector, Vector6};

use ulna::Arm;
use ulna::control::failure::LockedJoints;

/// The acceleration that joint torques add to the tool's, `J (M + R)⁻¹ τ` of the joints that are not `locked`:
/// `[linear; angular]`, world axes, m/s² and rad/s²; 0 outside the task.
///
/// A compensation in the null space of J holds no force at the tool (Eq. 13), but unless it is dynamically consistent it moves it
/// (Khatib, *A Unified Approach for Motion and Force Control of Robot Manipulators*, 1987). R is the `reflected_inertia` of the rotors.
/// `None` if rounding leaves M without a Cholesky factor, as only absurd arguments can.
pub fn tool_acceleration<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    q: &SVector<f64, N>,
    torque: &SVector<f64, N>,
    locked: LockedJoints<N>,
    reflected_inertia: &SVector<f64, N>,
) -> Option<Vector6<f64>> {
    let mass_matrix = arm.mass_matrix(q) + SMatrix::from_diagonal(reflected_inertia);
    let factor = Cholesky::new(locked.reduce_mass_matrix(&mass_matrix))?;
    let acceleration = factor.solve(&locked.without(torque));
    let twist = locked.reduce_jacobian(&arm.geometric_jacobian(q)) * acceleration;
    let mut of_task = Vector6::zeros();
    for row in arm.task().iter() {
        of_task[row.index()] = twist[row.index()];
    }
    Some(of_task)
}
