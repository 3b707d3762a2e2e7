//! [`Law`]: a compensation as lists; one cycle of the controller with it.

use nalgebra::Vector6;
use ulna::control::compensation::{Compensation, Controller, FreeTorque, Projector};
use ulna::{Cycle, Status};
use ulna_study::experiment::{AnyArm, ExperimentError};

use crate::StateList;
use crate::lists::{list, locked, state, vector, vector_or};

/// A law of compensation with its parameters: [`Compensation`], whatever the number of joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Law {
    /// No compensation.
    #[default]
    None,
    /// Eq. 16: the diagonal of k_d.
    PerJoint(Vec<f64>),
    /// Eq. 20: the diagonal of k_d.
    Projected(Vec<f64>),
    /// `U = P z + Jᵀ f`, one z and f as long as no joint is locked, others from then on.
    Optimal {
        /// As long as no joint is locked.
        before: FreeTorqueList,
        /// From the lock on.
        after: FreeTorqueList,
    },
}

/// [`FreeTorque`], whatever the number of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeTorqueList {
    /// z, N·m (N).
    pub torque: Vec<f64>,
    /// f, by which the static wrench of the tool is off, N and N·m.
    pub wrench: [f64; 6],
}

impl FreeTorqueList {
    fn of<const N: usize>(free: &FreeTorque<N>) -> Self {
        Self {
            torque: list(&free.torque),
            wrench: free.wrench.into(),
        }
    }

    fn free<const N: usize>(&self) -> Result<FreeTorque<N>, ExperimentError> {
        Ok(FreeTorque {
            torque: vector(&self.torque)?,
            wrench: self.wrench.into(),
        })
    }
}

impl Law {
    pub(crate) fn of<const N: usize>(compensation: &Compensation<N>) -> Self {
        match compensation {
            Compensation::PerJoint(k) => Self::PerJoint(list(k)),
            Compensation::Projected(k) => Self::Projected(list(k)),
            Compensation::Optimal { before, after } => Self::Optimal {
                before: FreeTorqueList::of(before),
                after: FreeTorqueList::of(after),
            },
        }
    }

    pub(crate) fn compensation<const N: usize>(&self) -> Result<Compensation<N>, ExperimentError> {
        Ok(match self {
            Self::None => Compensation::none(),
            Self::PerJoint(k) => Compensation::PerJoint(vector(k)?),
            Self::Projected(k) => Compensation::Projected(vector(k)?),
            Self::Optimal { before, after } => Compensation::Optimal {
                before: before.free()?,
                after: after.free()?,
            },
        })
    }
}

/// What a controller keeps to, beside its law.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// N·m (N); without a list those of the arm's table. One that is negative or no number counts as 0.
    pub rated_torque: Option<Vec<f64>>,
    /// The projector of the law.
    pub projector: Projector,
}

impl Default for Settings {
    /// The rated torques of the arm's table and the static projector.
    fn default() -> Self {
        Self {
            rated_torque: None,
            projector: Projector::Static,
        }
    }
}

/// What one control cycle gives: [`Cycle`], whatever the number of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlCycle {
    /// What motors give, and for a locked joint what its brake bears, N·m (N).
    pub torque: Vec<f64>,
    /// The same without compensation.
    pub planned: Vec<f64>,
    /// What of the compensation acts, after all cuts.
    pub compensation: Vec<f64>,
    /// By how much the static wrench of the tool is off, N and N·m; 0 outside the task.
    pub force_error: [f64; 6],
    /// What is left of the rated torques, N·m (N).
    pub margins: Vec<f64>,
    /// How independent the rows of the moving joints' Jacobian are, 0 to 1.
    pub conditioning: f64,
    /// How it went.
    pub status: Status,
}

impl<const N: usize> From<&Cycle<N>> for ControlCycle {
    fn from(cycle: &Cycle<N>) -> Self {
        Self {
            torque: list(&cycle.torque),
            planned: list(&cycle.planned),
            compensation: list(&cycle.compensation),
            force_error: cycle.force_error.into(),
            margins: list(&cycle.margins),
            conditioning: cycle.conditioning,
            status: cycle.status,
        }
    }
}

pub(crate) fn controller<'a, const N: usize>(
    arm: &'a AnyArm<N>,
    law: &Law,
    rated_torque: Option<&[f64]>,
    projector: Projector,
) -> Result<Controller<'a, AnyArm<N>, N>, ExperimentError> {
    let rated = vector_or(rated_torque, arm.rated_torque())?;
    let controller = Controller::new(arm, law.compensation()?);
    Ok(controller
        .with_projector(projector)
        .with_rated_torque(rated))
}

pub(crate) fn cycle<const N: usize>(
    arm: &AnyArm<N>,
    law: &Law,
    settings: &Settings,
    at: &StateList,
    wrench: &Vector6<f64>,
    joints: &[usize],
) -> Result<ControlCycle, ExperimentError> {
    let rated = settings.rated_torque.as_deref();
    let controller = controller(arm, law, rated, settings.projector)?;
    let cycle = controller.cycle(&state(at)?, wrench, locked(joints)?);
    Ok(ControlCycle::from(&cycle))
}
