//! The suppression controller: boundary conditions and compensated torque, Eq. 13–20.
//!
//! `τ = ID(q, q̇, q̈) + Jᵀ F_e + U`, with a compensation U that makes the torque before and after a lock alike.
//! `F_e` is the wrench that the tool exerts on its surroundings. J here is made of the task's rows.
//!
//! After joints have locked, their columns of J are 0 and so are their entries of ∇w_D (the text after Eq. 27):
//! w_D itself stays that of the whole arm, and a locked joint's motor gets no compensation.
//!
//! Rule near singular poses. With c the [`NullSpace::conditioning`](crate::control::null_space::NullSpace::conditioning) of the moving joints' J,
//! U is multiplied by `(c − SINGULAR) / (NEAR_SINGULAR − SINGULAR)`, at least 0 and at most 1. So U
//! stays continuous and bounded, and is 0 on the singular set, where w_D is 0 and Eq. 23 has no value.
//! [`Status::NearSingular`] says so wherever c is below [`NEAR_SINGULAR`](crate::control::null_space::NEAR_SINGULAR).

mod controller;
mod factor;
mod limits;
mod on_line;
mod pose;
mod whitening;

use nalgebra::{SVector, Vector6};

pub use controller::{Controller, Cycle};
pub use limits::Limits;
pub(crate) use on_line::nearest;
pub use on_line::{OnLine, Weighting};
pub use pose::{Projector, TaskPose};

/// A law of compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Law {
    /// Eq. 16: a coefficient for each joint's torque. Cancels any step; bends the tool force.
    PerJoint,
    /// Eq. 20: the coefficients inside the projector. Keeps the tool force; cancels only in part.
    Projected,
    /// Free torques in place of k_d ∇w_D, one before and one after the lock: the best that any compensation can do.
    Optimal,
}

/// A law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compensation<const N: usize> {
    /// [`Law::PerJoint`], `U_i = k_di (P ∇w_D)_i`: the diagonal of k_d.
    PerJoint(SVector<f64, N>),
    /// [`Law::Projected`], `U = P k_d ∇w_D`: the diagonal of k_d.
    Projected(SVector<f64, N>),
    /// [`Law::Optimal`], `U = P z + Jᵀ f`.
    Optimal {
        /// As long as no joint is locked.
        before: FreeTorque<N>,
        /// From the lock on.
        after: FreeTorque<N>,
    },
}

/// What [`Law::Optimal`] adds: `U = P z + Jᵀ f`. The static tool wrench is off by f, wherever the arm is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeTorque<const N: usize> {
    /// z, N·m (N), of which the part in the null space of J counts.
    pub torque: SVector<f64, N>,
    /// f, `[force; moment]`, world axes, N and N·m; 0 outside the task.
    pub wrench: Vector6<f64>,
}

impl<const N: usize> FreeTorque<N> {
    /// Nothing.
    pub fn none() -> Self {
        Self {
            torque: SVector::zeros(),
            wrench: Vector6::zeros(),
        }
    }
}

impl<const N: usize> Compensation<N> {
    /// No compensation at all.
    pub fn none() -> Self {
        Self::PerJoint(SVector::zeros())
    }

    /// Which law it is.
    pub fn law(&self) -> Law {
        match self {
            Self::PerJoint(_) => Law::PerJoint,
            Self::Projected(_) => Law::Projected,
            Self::Optimal { .. } => Law::Optimal,
        }
    }
}

/// How a control cycle went; of several the worst, which comes last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The whole compensation acts.
    Nominal,
    /// The compensation was cut down to keep Eq. 14.
    Saturated,
    /// The pose is near-singular: the compensation is faded out (the rule stands at the module's head).
    NearSingular,
    /// Motion and tool wrench alone ask for more than a rated torque, and the compensation does not cure it.
    /// The torque is cut to the rated one, and the tool wrench is not kept.
    Overloaded,
    /// An argument or a result is no finite number: torque and compensation are 0.
    NotFinite,
}
