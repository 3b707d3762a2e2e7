//! [`Field`]: the vector field over the joints that Eq. 16 and 20 multiply by coefficients.

use nalgebra::{DMatrix, SVector};

use ulna::control::compensation::{Projector, TaskPose};
use ulna::control::failure::LockedJoints;
use ulna::proof::random::SplitMix64;
use ulna::{Arm, TaskRow};

/// What stands in the place of ∇w_D in Eq. 16 and Eq. 20.
///
/// Whatever it is, the locked joints' entries are 0, the coefficients have their say at the lock alike,
/// and U fades out near singular poses. What it decides is what U does at all other times.
/// Its size means nothing: coefficients are searched in units of their own effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Field {
    /// ∇w_D of Eq. 22: the paper's.
    #[default]
    DynamicManipulability,
    /// ∇w of the kinematic manipulability `w = √det(J Jᵀ)` (Yoshikawa 1985), J of the task's rows and all joints.
    KinematicManipulability,
    /// 1 for every joint: `U = P k_d` under Eq. 20.
    Ones,
    /// A vector of random entries in −1 to 1, the same at all times; of this seed.
    Random(u64),
}

impl Field {
    /// [`TaskPose::new`] with this field in it.
    pub fn pose<const N: usize>(
        self,
        arm: &(impl Arm<N> + ?Sized),
        q: &SVector<f64, N>,
        locked: LockedJoints<N>,
        projector: Projector,
    ) -> TaskPose<N> {
        let mut pose = TaskPose::new(arm, q, locked, projector);
        if self != Self::DynamicManipulability {
            pose.gradient = locked.without(&self.at(arm, q));
        }
        pose
    }

    /// The field at `q`, no joint locked.
    pub(super) fn at<const N: usize>(
        self,
        arm: &(impl Arm<N> + ?Sized),
        q: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        match self {
            Self::DynamicManipulability => arm.jacobian_and_gradient(q).2,
            Self::KinematicManipulability => kinematic_manipulability_gradient(arm, q).1,
            Self::Ones => SVector::repeat(1.0),
            Self::Random(seed) => {
                let mut random = SplitMix64::stream(seed, 0);
                SVector::from_fn(|_, _| random.symmetric())
            }
        }
    }
}

/// `w = √det(J Jᵀ)` over the task's rows, in the units of J, and ∇w: `∂w/∂q_i = w tr(J† ∂J/∂q_i)`.
///
/// Both are 0 where the rows depend on each other: there ∇w does not exist.
pub fn kinematic_manipulability_gradient<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    q: &SVector<f64, N>,
) -> (f64, SVector<f64, N>) {
    let rows: Vec<usize> = arm.task().iter().map(TaskRow::index).collect();
    let jacobian = arm.geometric_jacobian(q);
    if rows.len() > N {
        return (0.0, SVector::zeros());
    }
    // Jᵀ = Q R: det(J Jᵀ) = det(R)², and J† = Q R⁻ᵀ, without the square of J's condition.
    let transposed = DMatrix::from_fn(N, rows.len(), |joint, row| jacobian[(rows[row], joint)]);
    let decomposition = transposed.qr();
    let r = decomposition.r();
    let w = r.diagonal().product().abs();
    let Some(solved) = r.solve_upper_triangular(&decomposition.q().transpose()) else {
        return (0.0, SVector::zeros());
    };
    let derivatives = arm.jacobian_derivatives(q);
    let gradient = SVector::from_fn(|i, _| {
        let derivative = &derivatives[i];
        // R⁻¹ Qᵀ is J†ᵀ, task rows × joints.
        let entries = rows.iter().enumerate().flat_map(|(row, index)| {
            let solved = &solved;
            (0..N).map(move |joint| solved[(row, joint)] * derivative[(*index, joint)])
        });
        w * entries.sum::<f64>()
    });
    (w, gradient)
}
