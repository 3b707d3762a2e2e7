//! The suppression controller of a real loop: one call a cycle, with the memory that smooth transitions need.
//!
//! [`Controller`](crate::Controller) has no memory: the same state gives the same torque, as a search wants it. In a loop that is not enough:
//! at a lock the best torque is the one nearest to the torque *commanded last*, laws are exchanged while the arm moves,
//! and actuators do not follow a compensation at any speed. [`SuppressionLoop`] does that around the same
//! `τ = ID(q, q̇, q̈) + Jᵀ F_e + U`, J made of the task's rows, with the static projector:
//!
//! | step | what it does |
//! |---|---|
//! | law | `U₁ = law(t)`, one [`SuppressionLaw`] while no joint is locked and another one after |
//! | anchor | `U₂ = U₁ + s(t) (P z₀ + Jᵀ f₀)`: at a lock, or when a law is exchanged, z₀ is what is missing to the last cycle; s goes from 1 to 0 |
//! | rate | `U₃` on the way from the last U to `U₂`, as far as the rate limit admits |
//! | rated torques | Eq. 14 ([`Limits::cut`](crate::control::compensation::Limits::cut)) |
//!
//! **Locks.** A cycle whose `locked` differs from the last one's takes the [`Recourse`]. The torque to go on with is the last one that was
//! commanded, whatever it was made of: `z₀ = τ_last − planned − U₁` over the joints that moved before and do still. So the healthy joints' torques
//! change by `J'†J' (planned − τ_last)`, the least that keeps the tool force within the budget; it does not matter how late the lock is told, nor
//! whether another one is being ramped out. A set that grows anew is the next lock; one that shrinks, a joint freed again, is treated alike,
//! the freed joint starting at what is planned.
//!
//! **Rate.** Laws that keep the tool force are held back as a whole: the last U is carried along with the null space, and the
//! largest share of the way from there to the wanted one is gone that no joint's rate forbids, so that the force stays kept. (Where the null space itself turns faster
//! than the limit, that part of the change does not count.) Eq. 16 is held back joint by joint. The cycle that takes a lock or a freed joint is exempt: the compensation has to jump there for the torque not to.
//!
//! **Rated torques** come last and before all else: Eq. 16 is cut joint by joint; the other laws are scaled as a whole, and where no scale will do the planned torque
//! is cut alone. What was cut is not remembered: the next cycle starts from what acted.
//!
//! A cycle with an argument or a result that is not finite gives no torque, and the loop forgets it: the next one goes on from the last good one.

mod anchor;
mod law;
mod rate;
mod schedule;

use nalgebra::{SVector, Vector6};

use crate::Arm;
use crate::control::compensation::{Cycle, Law, Limits, OnLine, Projector, Status, TaskPose};
use crate::control::failure::LockedJoints;
use crate::control::trajectory::JointState;
use anchor::Anchor;
pub use law::SuppressionLaw;
use rate::Carried;
pub use schedule::{Schedule, ScheduleError};

/// What is done in the cycle in which a lock is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recourse {
    /// Nothing: the law for locked joints acts at once.
    None,
    /// The torque nearest to the last one ([`OnLine::recourse`]), ramped out.
    Nearest {
        /// How far it may bend the static tool wrench, N (N·m where the task has moments).
        force_budget: f64,
    },
}

/// What one cycle of a [`SuppressionLoop`] gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopCycle<const N: usize> {
    /// As a [`Controller`](crate::Controller)'s.
    pub control: Cycle<N>,
    /// s: the share of the last anchor that still acts, 1 in the cycle that sets it, 0 if there is none.
    pub ramp: f64,
    /// Whether the rate limit holds U back.
    pub rate_limited: bool,
    /// The joints whose lock was told in this cycle.
    pub newly_locked: LockedJoints<N>,
    /// The joints that are free again from this cycle on.
    pub freed: LockedJoints<N>,
}

/// What the next cycle has to know of the last one.
#[derive(Clone, Copy, Debug)]
struct Memory<const N: usize> {
    time: f64,
    locked: LockedJoints<N>,
    /// τ as commanded.
    torque: SVector<f64, N>,
    carried: Carried<N>,
}

/// The suppression controller of a real loop (the [module](self) says how it works): no allocation, bounded time.
///
/// ```
/// use ulna::{LockedJoints, JointState, OnLine, SuppressionLoop};
/// # fn run(arm: &ulna::SerialChain<7>, read: impl Fn() -> (JointState<7>, LockedJoints<7>), write: impl Fn(&[f64])) {
/// let mut suppression = SuppressionLoop::on_line(arm, OnLine::equal()).with_ramp(0.5);
/// let wrench = ulna::nalgebra::Vector6::zeros();
/// for i in 0..1000 {
///     let (state, locked) = read();
///     let cycle = suppression.cycle(1e-3 * f64::from(i), &state, &wrench, locked);
///     write(cycle.control.torque.as_slice());
/// }
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SuppressionLoop<'a, A: ?Sized, const N: usize> {
    arm: &'a A,
    before: SuppressionLaw<'a, N>,
    after: SuppressionLaw<'a, N>,
    recourse: Recourse,
    ramp: f64,
    rate_limit: SVector<f64, N>,
    rated_torque: SVector<f64, N>,
    anchor: Option<Anchor<N>>,
    /// A law or the arm was exchanged since the last cycle: whether both of them keep the tool force.
    switched: Option<bool>,
    memory: Option<Memory<N>>,
}

impl<'a, A: Arm<N> + ?Sized, const N: usize> SuppressionLoop<'a, A, N> {
    /// A loop with one law while no joint is locked and another one after, without a recourse, rate limits or a past,
    /// with the arm's own rated torques and a ramp of 1 s.
    pub fn new(arm: &'a A, before: SuppressionLaw<'a, N>, after: SuppressionLaw<'a, N>) -> Self {
        Self {
            arm,
            before,
            after,
            recourse: Recourse::None,
            ramp: 1.0,
            rate_limit: SVector::repeat(f64::INFINITY),
            rated_torque: arm.rated_torque(),
            anchor: None,
            switched: None,
            memory: None,
        }
    }

    /// A loop with the on-line law before and after, for the next lock, and the nearest torque within its force budget at each.
    pub fn on_line(arm: &'a A, law: OnLine<N>) -> Self {
        let both = SuppressionLaw::OnLine(law);
        Self::new(arm, both, both).with_recourse(Recourse::Nearest {
            force_budget: law.force_budget,
        })
    }

    /// The same with another recourse.
    #[must_use]
    pub fn with_recourse(mut self, recourse: Recourse) -> Self {
        self.recourse = recourse;
        self
    }

    /// The same with anchors that take `ramp` s to go; 0, or what is not above it, sets none.
    #[must_use]
    pub fn with_ramp(mut self, ramp: f64) -> Self {
        self.ramp = ramp;
        self
    }

    /// The same with a limit of the rate of U, N·m/s (N/s), for each joint. One that is negative or no number counts as 0.
    #[must_use]
    pub fn with_rate_limit(mut self, rate_limit: SVector<f64, N>) -> Self {
        self.rate_limit = rate_limit.map(|rate| rate.max(0.0));
        self
    }

    /// The same with other rated torques, N·m (N). One that is negative or no number counts as 0.
    #[must_use]
    pub fn with_rated_torque(mut self, rated_torque: SVector<f64, N>) -> Self {
        self.rated_torque = rated_torque.map(|rated| rated.max(0.0));
        self
    }

    /// Exchanges the law that acts now (that for locked joints once one is locked); U goes over to it within the ramp.
    pub fn switch(&mut self, law: SuppressionLaw<'a, N>) {
        let acting = self.acting();
        let keep = acting.keeps_force() && law.keeps_force();
        *acting = law;
        self.switched = Some(keep && self.switched.unwrap_or(true));
    }

    /// Goes on with another arm of the same joints, such as the same one with another payload;
    /// U goes over to what the law wants of it within the ramp.
    pub fn set_arm(&mut self, arm: &'a A) {
        let keep = self.acting().keeps_force();
        self.arm = arm;
        self.switched = Some(keep && self.switched.unwrap_or(true));
    }

    /// The law that acts now.
    fn acting(&mut self) -> &mut SuppressionLaw<'a, N> {
        if self.memory.is_some_and(|last| !last.locked.is_empty()) {
            &mut self.after
        } else {
            &mut self.before
        }
    }

    /// Forgets what was: the next cycle is the first one, without anything to be smooth with.
    pub fn reset(&mut self) {
        self.anchor = None;
        self.switched = None;
        self.memory = None;
    }

    /// One cycle: the torques at `time` (s, from any origin, not decreasing) for `state`, measured or planned, of an arm whose tool is to exert
    /// `wrench` (`[f; n]`, world axes, at the tool point) and of which `locked` joints are known to stand still, whatever `state` says of them.
    #[inline]
    pub fn cycle(
        &mut self,
        time: f64,
        state: &JointState<N>,
        wrench: &Vector6<f64>,
        locked: LockedJoints<N>,
    ) -> LoopCycle<N> {
        let was = self.memory.map_or(locked, |last| last.locked);
        let mut result = LoopCycle {
            control: Cycle::nothing(self.rated_torque),
            ramp: 0.0,
            rate_limited: false,
            newly_locked: locked.difference(was),
            freed: was.difference(locked),
        };
        let finite = time.is_finite() && state.is_finite() && wrench.iter().all(|x| x.is_finite());
        if !finite {
            return result;
        }

        let state = locked.hold(state);
        let pose = TaskPose::new(self.arm, &state.q, locked, Projector::Static);
        let planned = self.arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
            + pose.jacobian.tr_mul(wrench);
        let law = if locked.is_empty() {
            &self.before
        } else {
            &self.after
        };
        let of_law = law.compensation(self.arm, time, &state, &pose, locked);

        let anchor = self.next_anchor(time, &pose, &planned, &of_law, locked);
        let mut wanted = of_law;
        let mut kind = law.kind();
        if let Some(anchor) = &anchor {
            result.ramp = anchor.share(time);
            wanted += anchor.torque(&pose, locked) * result.ramp;
            if !anchor.keeps_force() {
                kind = Law::PerJoint;
            }
        }

        let mut u = wanted;
        if let Some(last) = self.memory.filter(|last| last.locked == locked) {
            let admitted = rate::admitted(&self.rate_limit, time - last.time);
            (u, result.rate_limited) = match kind {
                Law::PerJoint => last.carried.joint_by_joint(&wanted, &admitted),
                _ => last.carried.as_a_whole(&pose, locked, &wanted, &admitted),
            };
        }

        let limits = Limits {
            rated_torque: self.rated_torque,
            locked,
        };
        let (torque, cut) = limits.cut(&planned, &u, kind);
        result.control = Cycle::close(&pose, planned, torque, cut, self.rated_torque);
        if result.control.status == Status::NotFinite {
            return result;
        }
        self.anchor = anchor;
        self.switched = None;
        let dropped = cut == Status::Overloaded && kind != Law::PerJoint;
        self.memory = Some(Memory {
            time,
            locked,
            torque,
            carried: if dropped {
                Carried::nothing()
            } else {
                Carried::new(&pose, &result.control)
            },
        });
        result
    }

    /// The anchor of this cycle: a new one at a lock, a freed joint or another law; otherwise the last one, until it has gone.
    fn next_anchor(
        &self,
        time: f64,
        pose: &TaskPose<N>,
        planned: &SVector<f64, N>,
        of_law: &SVector<f64, N>,
        locked: LockedJoints<N>,
    ) -> Option<Anchor<N>> {
        let last = self.memory?;
        if last.locked != locked {
            let Recourse::Nearest { force_budget } = self.recourse else {
                return None;
            };
            // A joint that is locked, or was, has no torque to go on with.
            let moving = last.locked.union(locked);
            let missing = moving.without(&(last.torque - planned - of_law));
            Anchor::nearest(time, self.ramp, pose, &missing, force_budget)
        } else if let Some(keep) = self.switched {
            let missing = last.carried.compensation() - of_law;
            if keep {
                // Both laws' bent forces are meant: what lies between them is admitted.
                Anchor::nearest(time, self.ramp, pose, &missing, f64::INFINITY)
            } else {
                Anchor::whole(time, self.ramp, &missing)
            }
        } else {
            self.anchor.filter(|anchor| anchor.share(time) > 0.0)
        }
    }
}
