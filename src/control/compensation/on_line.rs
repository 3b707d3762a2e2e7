//! [`OnLine`]: the compensation that prepares for the next lock, whichever joint it takes, from the state alone.
//!
//! Let P = I − J†J be the static projector of the joints that still move, and let one of them, k, lock. The healthy joints'
//! torque would step by `s_k` (after minus before, entry k left out). Take U = P z before the lock, which keeps the static tool force,
//! and the best U' after it that keeps it too: U' in the null space of `J_k`, J without column k. What is left of the step is then
//!
//! `r_k + g_k U_k`, with `r_k = J_k†J_k s_k` and `g_k = J_k† J e_k`:
//!
//! **of the whole compensation only its k-th entry matters to lock k**, and the best one is `u*_k = −g_k·r_k / |g_k|²`. So the best U for
//! all joints at risk at once is the least-squares problem in the null space of J
//!
//! `min Σ_k w_k |g_k|² (U_k − u*_k)² + δ² |U|²`.
//!
//! Nothing has to be inverted for it. The null space of `J_k` is that of J without the direction `n_k = P e_k / |P e_k|`
//! (Sherman and Morrison), and with `m_k`, `n_k` without its entry k: `g_k = −m_k / |P e_k|`, `|g_k|² = |m_k|² / P_kk`,
//! `|m_k|² = 1 − P_kk`, and `g_k·r_k = g_k·s_k`. As `U_k = |P e_k| n_k·U`, the problem's normal equations are
//!
//! `(Σ_k w_k |m_k|² n_k n_kᵀ + δ² I) U = Σ_k w_k (m_k·s_k) n_k`,
//!
//! in which nothing grows as `P_kk` goes to 0, and whose solution lies in the null space by itself.
//!
//! A lock of k divides the volume of J's rows by `1 / √P_kk = 1 / |P e_k|`: where that is near 0, `J_k` is near-singular, there is no
//! recourse after the lock, and w_k and `s_k` fade as U does near singular poses (the rule at [`super`]'s head).
//! All bounds: `|U| ≤ √(Σ w_k |s_k|²) / 2δ`, so that U is bounded wherever the arm is.

use nalgebra::{SMatrix, SVector, Vector6};

use super::factor::Factor;
use super::{FreeTorque, TaskPose};
use crate::control::failure::{LockedJoints, impact_of_motion};
use crate::control::null_space::{NEAR_SINGULAR, SINGULAR};
use crate::control::trajectory::JointState;
use crate::{Arm, Real};

/// How the residual of a lock counts beside another's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weighting {
    /// In N·m: large steps are made smaller first, and small ones may grow for it.
    Absolute,
    /// As a share of the lock's own step: `w_k` is divided by `|s_k|² + floor²`, and multiplied by the mean of that over all joints at risk,
    /// weighted with `w_k`, so that δ keeps its meaning for a step of mean size.
    Relative {
        /// Steps far below it count as if they had this size, N·m; not below 0.
        floor: f64,
    },
}

/// The on-line law: before each lock the U that leaves the least of the step, in the mean over the joints at risk (the equations stand
/// at the module's head); after it [`recourse`](Self::recourse), the torque nearest to that before.
///
/// It needs no plan, no failure time and no search: one cycle's state, and what each joint's lock would do in it ([`Arm::lock_impacts`]).
/// The static tool force is kept exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnLine<const N: usize> {
    /// `w_k`: how much each joint is at risk, e.g. its probability to lock; what is not above 0 and finite is no risk.
    pub weights: SVector<f64, N>,
    /// What they weigh.
    pub weighting: Weighting,
    /// δ: 1 N·m of compensation weighs as δ N·m of residual at `w_k = 1`. At least [`LEAST_DAMPING`](Self::LEAST_DAMPING) times √(max `w_k`) is taken.
    pub damping: f64,
    /// ε, N (N·m): how far the recourse after a lock may bend the static tool wrench; at least 0. The law before the lock is that for ε = 0.
    pub force_budget: f64,
}

impl<const N: usize> OnLine<N> {
    /// The least δ for weights of 1. The square root of what double precision can tell from 0 in a matrix of squares.
    pub const LEAST_DAMPING: f64 = 1e-4;

    /// Every joint at the same risk, each lock by the share of its own step, the tool force untouched.
    ///
    /// Chosen by measurement on the motion of `scenarios/paper_like.toml`, every joint locking at 191 times: residual rms over all locks and
    /// over those of joint 2, N·m; the geometric mean and the largest of residual / step over joints 1 to 6; the share of those
    /// 1,146 cases that end more than 1 % above their step; the largest entry of U, N·m.
    ///
    /// | weighting, damping | all | joint 2 | mean ratio | largest | worse | U |
    /// |---|---|---|---|---|---|---|
    /// | no compensation | 126.4 | 60.8 | 1 | 1 | | 0 |
    /// | recourse only | 125.4 | 60.1 | 0.99 | 1 | 0 % | 0 |
    /// | absolute, 0 | 117.7 | 54.6 | 1.53 | 113 | 51 % | 692 |
    /// | absolute, 0.3 | 118.3 | 63.9 | 1.39 | 48.7 | 49 % | 298 |
    /// | absolute, 1 | 120.1 | 65.0 | 1.15 | 7.9 | 40 % | 70 |
    /// | relative to 30 N·m, 1 | 124.7 | 48.8 | 1.06 | 21.2 | 27 % | 56 |
    /// | relative to 1 N·m, 0 | 125.8 | 45.3 | 0.86 | 1.18 | 23 % | 154 |
    /// | **relative to 1 N·m, 1** | 125.6 | 48.6 | 0.88 | 1.15 | 19 % | 55 |
    /// | each joint as if known to lock | 109.1 | 33.3 | 0.74 | 1 | 0 % | 819 |
    pub fn equal() -> Self {
        Self {
            weights: SVector::repeat(1.0),
            weighting: Weighting::Relative { floor: 1.0 },
            damping: 1.0,
            force_budget: 0.0,
        }
    }

    /// U before the next lock, N·m (N), for `state` of an arm whose `locked` joints stand still already; `pose` is the arm's with the same
    /// joints locked. The projector is the static one, whatever that of `pose`.
    ///
    /// Exactly 0 where the moving joints have no null space, where none is at risk, and where the state has no finite torques.
    #[inline]
    pub fn compensation(
        &self,
        arm: &(impl Arm<N> + ?Sized),
        state: &JointState<N>,
        pose: &TaskPose<N>,
        locked: LockedJoints<N>,
    ) -> SVector<f64, N> {
        if pose.has_no_null_space() {
            return SVector::zeros();
        }
        let state = locked.hold(state);
        let at_risk = locked.healthy().filter(|joint| {
            let weight = self.weights[*joint];
            weight > 0.0 && weight.is_finite()
        });
        // For one joint alone two inverse dynamics are less.
        let several = at_risk.clone().nth(1).is_some();
        let impacts = several.then(|| arm.lock_impacts(&state.q, &state.qd, &state.qdd));
        let mut risks = [Risk::none(); N];
        for joint in at_risk {
            // Δτ is before minus after, and the step after minus before.
            let step = match &impacts {
                Some(impacts) => -impacts.column(joint),
                None => {
                    let next = LockedJoints::new(&[joint]).unwrap_or(LockedJoints::NONE);
                    -impact_of_motion(arm, &state, next)
                }
            };
            risks[joint] = Risk::new(joint, self.weights[joint], &locked.without(&step), pose);
        }
        if let Weighting::Relative { floor } = self.weighting {
            make_relative(&mut risks, floor);
        }
        let u = pose.project_static(&self.least_squares(&risks));
        if u.iter().all(|x| x.is_finite()) {
            u
        } else {
            SVector::zeros()
        }
    }

    /// The normal equations, divided by the largest weight.
    #[inline]
    fn least_squares(&self, risks: &[Risk<N>; N]) -> SVector<f64, N> {
        let largest = risks.iter().fold(0.0_f64, |w, risk| w.max(risk.weight));
        if largest == 0.0 {
            return SVector::zeros();
        }
        let damping =
            (self.damping * self.damping / largest).max(Self::LEAST_DAMPING * Self::LEAST_DAMPING);
        let mut matrix = SMatrix::<f64, N, N>::from_diagonal_element(damping);
        let mut right = SVector::<f64, N>::zeros();
        for risk in risks {
            let weight = risk.weight / largest;
            right.axpy(weight * risk.along, &risk.direction, 1.0);
            let weighted = risk.direction * (weight * risk.gain);
            for j in 0..N {
                matrix.column_mut(j).axpy(risk.direction[j], &weighted, 1.0);
            }
        }
        match Factor::new(&matrix) {
            Some(factor) => factor.solve_whole(right),
            None => SVector::zeros(),
        }
    }

    /// U' after a lock, N·m (N): as near as can be to `wanted`, the healthy torques before the lock minus those planned after it.
    ///
    /// `P' wanted + J'ᵀ f`: the part that leaves the tool force alone, and of the rest what a bent force can do: f is the static
    /// wrench of `wanted`, no longer than `force_budget` (N, and N·m where the task has moments). The locked joints' entries are 0;
    /// all of it fades near singular poses.
    #[inline]
    pub fn recourse(
        pose_after: &TaskPose<N>,
        wanted: &SVector<f64, N>,
        force_budget: f64,
    ) -> SVector<f64, N> {
        pose_after.free_torque(&nearest(pose_after, wanted, force_budget))
    }
}

/// What [`OnLine::recourse`] takes of `wanted`.
#[inline]
pub(crate) fn nearest<const N: usize>(
    pose: &TaskPose<N>,
    wanted: &SVector<f64, N>,
    force_budget: f64,
) -> FreeTorque<N> {
    let mut wrench = Vector6::zeros();
    if force_budget > 0.0 {
        wrench = pose.null_space.static_wrench(wanted);
        let length = wrench.norm();
        if length > force_budget {
            wrench *= force_budget / length;
        }
    }
    FreeTorque {
        torque: *wanted,
        wrench,
    }
}

/// What a lock of one joint means to the law.
#[derive(Clone, Copy)]
struct Risk<const N: usize> {
    /// `w_k`, faded where there is no recourse.
    weight: f64,
    /// `n_k`.
    direction: SVector<f64, N>,
    /// `|m_k|² = 1 − P_kk`.
    gain: f64,
    /// `m_k·s_k`, N·m (N), faded likewise: where a single joint is at risk, its weight alone does not decide.
    along: f64,
    /// `|s_k|²`.
    step_squared: f64,
}

impl<const N: usize> Risk<N> {
    fn none() -> Self {
        Self {
            weight: 0.0,
            direction: SVector::zeros(),
            gain: 0.0,
            along: 0.0,
            step_squared: 0.0,
        }
    }

    /// A lock of `joint`, the healthy joints' torques stepping by `step`, whose entry `joint` does not count.
    #[inline]
    fn new(joint: usize, weight: f64, step: &SVector<f64, N>, pose: &TaskPose<N>) -> Self {
        let mut axis = SVector::<f64, N>::zeros();
        axis[joint] = 1.0;
        // Its length rather than its entry `joint`, of which rounding would leave less: both are √P_kk.
        let column = pose.null_space.project(&axis);
        let length = Real::sqrt(column.norm_squared());
        if length <= SINGULAR {
            return Self::none();
        }
        let direction = column / length;
        let mut others = direction;
        others[joint] = 0.0;
        let mut step = *step;
        step[joint] = 0.0;
        let fade = ((length - SINGULAR) / (NEAR_SINGULAR - SINGULAR)).min(1.0);
        Self {
            weight: weight * fade,
            direction,
            gain: others.norm_squared(),
            along: others.dot(&step) * fade,
            step_squared: step.norm_squared(),
        }
    }
}

/// [`Weighting::Relative`].
fn make_relative<const N: usize>(risks: &mut [Risk<N>; N], floor: f64) {
    let size = |risk: &Risk<N>| risk.step_squared + floor * floor;
    let (mut sum, mut weights) = (0.0, 0.0);
    for risk in risks.iter() {
        sum += risk.weight * size(risk);
        weights += risk.weight;
    }
    for risk in risks.iter_mut() {
        let size = size(risk);
        // Without a step and without a floor there is nothing to take a share of.
        risk.weight = if size > 0.0 && weights > 0.0 {
            risk.weight * (sum / weights) / size
        } else {
            0.0
        };
    }
}
