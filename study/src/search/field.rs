//! [`Field`]: the vector field over the joints that Eq. 16 and 20 multiply by coefficients.

use nalgebra::SVector;

use ulna::Arm;
use ulna::control::compensation::{Projector, TaskPose};
use ulna::control::failure::LockedJoints;
use ulna::proof::random::SplitMix64;

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
            Self::KinematicManipulability => arm.manipulability_gradient(q).1,
            Self::Ones => SVector::repeat(1.0),
            Self::Random(seed) => {
                let mut random = SplitMix64::stream(seed, 0);
                SVector::from_fn(|_, _| random.symmetric())
            }
        }
    }
}
