//! The search for a compensation: coefficients k_d by Eq. 21 and 28, the paper's way and exactly, and the best there is.
//!
//! An [`Operation`] is a planned motion with a failure in it, looked at once at every sample time.
//! Everything that is searched for enters it linearly, `U(t) = A(t) x`, so that the torque step at the failure is too:
//! `Δτ̃ = τ(t_f + Δt) − τ(t_f) = step + U(t_f + Δt) − U(t_f)` (Eq. 18), and so are the rated torques' limits (Eq. 14)
//!
//! - [`Stepwise`] searches as the paper does (Figure 2);
//! - [`cancel_per_joint`] solves Eq. 16 in closed form, joint by joint;
//! - [`least_impact`] solves Eq. 20 exactly;
//! - [`optimal()`] does without k_d and ∇w_D, and [`frontier`] trades tool force for impact; [`Optimum`] asks for fairness among joints;
//! - [`lower_every_joint`] proves that no compensation which keeps the tool force lowers every joint, or finds one.

mod coefficients;
mod convex;
mod field;
mod interval;
mod operation;
mod options;
mod recourse;
mod stepwise;
mod worse;

use ulna::control::compensation::Compensation;

pub use coefficients::{CoefficientLaw, cancel_per_joint, equivalent_per_joint};
pub use convex::{
    Acts, BestConstant, Certificate, Fairness, ForcePriority, FrontierPoint, LowerAll, Moment,
    Objective, Optimum, RobustObjective, RobustOptions, RobustPlan, RobustSample, Scope,
    best_constant, frontier, least_impact, lower_every_joint, optimal, robust,
};
pub use field::Field;
pub use interval::{Interval, feasible_interval};
pub use operation::{Assessment, OperatingPoint, Operation};
pub use options::{EFFORT, OperationOptions};
pub use recourse::nearest_torque;
pub use stepwise::Stepwise;
pub use worse::{WorseJoint, worse_joints};

/// Why there is nothing to search, or nothing to find. Joints count from 0 in the fields and from 1 in the messages.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The lock and the first torque after it do not lie within the motion.
    #[error(
        "the failure at {time} s (and the step time after it) must lie within the motion's {duration} s"
    )]
    FailureTime {
        /// t_f, s.
        time: f64,
        /// The motion's, s.
        duration: f64,
    },
    /// The motion or the wrench leads to torques that are no finite numbers.
    #[error("the planned torque at {time:.3} s is not finite")]
    NotFinite {
        /// When, s.
        time: f64,
    },
    /// No value keeps Eq. 14: the interval of Eq. 28 is empty.
    #[error("no compensation keeps joint {} within its rated torque at {time:.3} s", joint + 1)]
    Empty {
        /// The joint that empties the interval, from 0.
        joint: usize,
        /// When it does, s.
        time: f64,
    },
    /// An argument that makes no operation or no search.
    #[error("the {name} must be {range}, not {value}")]
    Argument {
        /// Which.
        name: &'static str,
        /// What is allowed.
        range: &'static str,
        /// What it was.
        value: f64,
    },
    /// The solver stopped without an answer.
    #[error("the solver stopped without a solution: {0}")]
    NotSolved(&'static str),
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolveStatus {
    /// By formula: no limit binds, or the problem falls apart joint by joint.
    ClosedForm,
    /// The solver met its tolerances.
    Solved,
    /// The solver met weaker tolerances only; see the gap.
    AlmostSolved,
    /// No neighbour on the grid is better.
    GridOptimum,
    /// The steps ran out first.
    StepLimit,
}

impl SolveStatus {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::ClosedForm => "by formula",
            Self::Solved => "solved",
            Self::AlmostSolved => "almost solved",
            Self::GridOptimum => "best of its neighbours on the grid",
            Self::StepLimit => "stopped at the step limit",
        }
    }
}

/// What a search found, and what it is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<const N: usize> {
    /// The law with its parameters.
    pub compensation: Compensation<N>,
    /// What it does to the operation.
    pub assessment: Assessment<N>,
    /// How the search ended.
    pub status: SolveStatus,
    /// The solver's optimality gap, primal minus dual objective, N²m² or N·m; 0 for a closed form, `None` on a grid.
    pub gap: Option<f64>,
    /// Steps on the grid, or iterations of the solver.
    pub iterations: usize,
    /// How long the search took, s.
    pub seconds: f64,
}
