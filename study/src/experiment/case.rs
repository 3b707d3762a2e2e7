//! [`Case`]: what came of one experiment, one failure time and one [`SearchMethod`].

use super::{CoefficientBound, ForceKept, Rollout};
use crate::search::{SearchError, SolveStatus, WorseJoint, worse_joints};
use ulna::Law;

/// How a compensation is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SearchMethod {
    /// Eq. 16 by the paper's search (Figure 2).
    StepwisePerJoint,
    /// Eq. 16 exactly.
    PerJoint,
    /// Eq. 20 by the paper's search, repeated until no coefficient moves.
    StepwiseProjected,
    /// Eq. 20 exactly: the least norm over the healthy joints.
    Projected,
    /// The least norm over the healthy joints that any compensation leaves that keeps the static tool force.
    Optimal,
}

impl SearchMethod {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::StepwisePerJoint,
        Self::PerJoint,
        Self::StepwiseProjected,
        Self::Projected,
        Self::Optimal,
    ];

    /// What it is called in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::StepwisePerJoint => "eq16_steps",
            Self::PerJoint => "eq16",
            Self::StepwiseProjected => "eq20_steps",
            Self::Projected => "eq20",
            Self::Optimal => "optimal",
        }
    }

    /// The law whose parameters it finds.
    pub fn law(self) -> Law {
        match self {
            Self::StepwisePerJoint | Self::PerJoint => Law::PerJoint,
            Self::StepwiseProjected | Self::Projected => Law::Projected,
            Self::Optimal => Law::Optimal,
        }
    }

    /// Whether it is the paper's search in steps.
    pub fn is_stepwise(self) -> bool {
        matches!(self, Self::StepwisePerJoint | Self::StepwiseProjected)
    }
}

/// One experiment, one failure time, one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// [`Experiment::section`](crate::scenario::Experiment::section).
    pub section: String,
    /// How the compensation was found.
    pub method: SearchMethod,
    /// The joints that lock, counted from 0.
    pub failed_joints: Vec<usize>,
    /// When, s.
    pub failure_time: f64,
    /// Δt of Eq. 18, s.
    pub step_time: f64,
    /// The rated torques kept, N·m (N); infinite where a joint has none, `None` if none has.
    pub rated_torque: Option<Vec<f64>>,
    /// |Δτ̃_i| without compensation, N·m (N).
    pub impact_before: Vec<f64>,
    /// |Δτ̃_i| with compensation, N·m (N). A locked joint's goes into its brake.
    pub impact_after: Vec<f64>,
    /// The diagonal of k_d. [`Law::Optimal`] has none: for it those of Eq. 16 that would change the step at the lock alike
    /// ([`equivalent_per_joint`](crate::search::equivalent_per_joint)).
    pub coefficients: Vec<f64>,
    /// What keeps each coefficient of Eq. 16 from cancelling its joint's step; `None` where nothing does, and for the other laws.
    pub bounds: Vec<Option<CoefficientBound>>,
    /// h of Eq. 13 at the lock, the larger norm of just before and just after, N (with the moments' N·m, if the task has any).
    pub force_error: f64,
    /// How the search ended; `Err` if there is nothing that keeps the limits, and no compensation then.
    pub search: Result<Search, SearchError>,
    /// The whole motion under the controller.
    pub rollout: Rollout,
}

/// How the search for a compensation ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Found how.
    pub status: SolveStatus,
    /// Primal minus dual objective; `None` on a grid.
    pub gap: Option<f64>,
    /// Steps on the grid, or iterations of the solver.
    pub iterations: usize,
    /// The time it took, s.
    pub seconds: f64,
}

impl Case {
    /// 100 (1 − after/before) for each joint; 0 where there is no impact to suppress, but rounding.
    pub fn suppression_percent(&self) -> Vec<f64> {
        /// Below this share of the largest joint's impact another's is rounding.
        const ROUNDING: f64 = 1e-12;
        let largest = self.impact_before.iter().copied().fold(0.0, f64::max);
        let joints = self.impact_before.iter().zip(&self.impact_after);
        joints
            .map(|(before, after)| {
                if *before > ROUNDING * largest {
                    100.0 * (1.0 - after / before)
                } else {
                    0.0
                }
            })
            .collect()
    }

    /// The healthy joints that bear more with the compensation than without.
    pub fn worse_joints(&self) -> Vec<WorseJoint> {
        worse_joints(&self.impact_before, &self.impact_after, &self.failed_joints)
    }

    /// The norm of the impact over the joints that are not locked: before and after, N·m.
    pub fn healthy_impact(&self) -> (f64, f64) {
        let norm = |impact: &[f64]| {
            let joints = impact.iter().enumerate();
            let healthy = joints.filter(|(joint, _)| !self.failed_joints.contains(joint));
            healthy
                .map(|(_, torque)| torque * torque)
                .sum::<f64>()
                .sqrt()
        };
        (norm(&self.impact_before), norm(&self.impact_after))
    }
}

/// What force error buys: the least impact over the healthy joints for each force error at the lock.
#[derive(Clone, Debug, PartialEq)]
pub struct Tradeoff {
    /// Force error, N, and the norm of the impact, N·m; ascending in the first.
    pub frontier: Vec<(f64, f64)>,
}

/// All cases of an experiment at one failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// [`Experiment::section`](crate::scenario::Experiment::section).
    pub section: String,
    /// s.
    pub failure_time: f64,
    /// One for each [`SearchMethod`], in the order of [`SearchMethod::ALL`].
    pub cases: Vec<Case>,
    /// The frontier that [`SearchMethod::Optimal`] is the end of; `None` where the limits leave no compensation at all.
    pub tradeoff: Option<Tradeoff>,
    /// What the tool force, kept exactly, leaves to any law.
    pub force_kept: ForceKept,
}

impl Study {
    /// The case of `method`.
    pub fn case(&self, method: SearchMethod) -> &Case {
        &self.cases[method as usize]
    }
}
