//! Where a task is singular: one rule for the textbook, generated code and the controller.
//!
//! **w_D counts as 0, and ∇w_D is the zero vector, where the task's rows of J span no volume but rounding:**
//!
//! `√det(Ĵ Ĵᵀ) ≤ 16 N ε`, ε = 2.2e-16,
//!
//! the kinematic manipulability (Yoshikawa 1985) of Ĵ: the task's rows of J, those of v divided by the
//! [`length`] of the chain, so that it has no unit. Masses do not enter. M⁻¹ has full rank, so that
//! H = JM⁻¹ is singular where J is; and J's rounding is known, a few ε of 1 for a direction and of the chain's length for an arm.
//! A volume does not depend on the order of the rows, nor on the axes that J is written in.
//!
//! Beyond the threshold w_D and ∇w_D are what the formulas give, w_D going to 0 with the volume: at the threshold w_D falls from
//! a number without certain digits to 0, and ∇w_D, whose length does not go to 0 on a singular pose but whose direction changes
//! sign there, falls to the zero vector. What digits are certain on the way there: rounding in J is about ε of 1, so that
//! a volume that is v times what the lengths of its rows would span leaves a relative error of some ε / v in w_D and ∇w_D.
//!
//! Λ, J̄, and w with ∇w ([`Arm::task_space_inertia`](crate::Arm::task_space_inertia) and those after it) have no value there either, or no slope:
//! they are 0 by the same rule.
//!
//! The controller lets go long before: see [`crate::control::compensation`]. Where w_D counts as 0 its status is
//! [`NearSingular`](crate::Status::NearSingular), without exception.

use crate::{Joint, JointKind, Placement, SerialChain, TaskRow, TaskRows};

/// An upper bound of the distance between any two origins of a chain at `q`, m: the joints' offsets, component by component,
/// added up with the tool's. At least 1 m where a joint slides, which moves the tool by 1 m a metre; 1 m if all origins coincide.
///
/// It sets the scale for what of J counts as rounding.
#[inline(always)]
pub const fn length(joints: &[Joint], tool: &Placement, q: &[f64]) -> f64 {
    let [x, y, z] = tool.translation;
    let mut length = x.abs() + y.abs() + z.abs();
    let mut least = 0.0;
    let mut i = 0;
    while i < joints.len() {
        length += joints[i].a.abs() + joints[i].d.abs();
        if matches!(joints[i].kind, JointKind::Prismatic) {
            length += q[i].abs();
            least = 1.0;
        }
        i += 1;
    }
    if length == 0.0 {
        1.0
    } else if length < least {
        least
    } else {
        length
    }
}

/// det(JJᵀ) over the rows of `task`, in SI units, up to which w_D counts as 0:
/// the square of `16 N ε`, and of the [`length`] for each row of v.
#[inline(always)]
pub const fn least_volume_squared(
    joints: &[Joint],
    tool: &Placement,
    task: TaskRows,
    q: &[f64],
) -> f64 {
    let length = length(joints, tool, q);
    let mut least = 16.0 * joints.len() as f64 * f64::EPSILON;
    let mut row = 0;
    while row < 3 {
        if task.contains(TaskRow::ALL[row]) {
            least *= length;
        }
        row += 1;
    }
    least * least
}

/// Whether `volume_squared` counts as 0 at `q`, where `least` is the [`least_volume_squared`].
///
/// A volume that is NaN has been divided by a row of length 0: singular, unless `q` itself is no configuration.
#[inline(always)]
pub const fn counts_as_zero(volume_squared: f64, least: f64, q: &[f64]) -> bool {
    if volume_squared > least {
        return false;
    }
    let mut i = 0;
    while i < q.len() {
        if !q[i].is_finite() {
            return false;
        }
        i += 1;
    }
    true
}

impl<const N: usize> SerialChain<N> {
    /// The chain's [`length`] at `q`, m.
    #[inline(always)]
    pub const fn length(&self, q: &[f64; N]) -> f64 {
        length(&self.joints, &self.tool, q)
    }

    /// Whether w_D counts as 0 at `q`, from `volume_squared` = det(JJᵀ) over the task's rows, in SI units: [`counts_as_zero`].
    #[inline(always)]
    pub const fn is_singular(&self, q: &[f64; N], volume_squared: f64) -> bool {
        let least = least_volume_squared(&self.joints, &self.tool, self.task, q);
        counts_as_zero(volume_squared, least, q)
    }
}
