//! [`Plan`]: a motion that an arm can execute.

use std::any::Any;

use ulna::{JointState, Trajectory};
use ulna_study::experiment::{AnyArm, ExperimentError};
use ulna_study::scenario::{Motion, PlannedMotion};

use crate::lists::list;

/// The largest time between two knots of a tool path, s: as in scenarios.
const KNOT_PERIOD: f64 = 0.02;

/// Where the joints are and how they move, one entry for each.
#[derive(Clone, Debug, PartialEq)]
pub struct StateList {
    /// Positions, rad (m).
    pub q: Vec<f64>,
    /// Rates, rad/s (m/s).
    pub qd: Vec<f64>,
    /// Accelerations, rad/s² (m/s²).
    pub qdd: Vec<f64>,
}

impl StateList {
    pub(crate) fn of<const N: usize>(state: &JointState<N>) -> Self {
        Self {
            q: list(&state.q),
            qd: list(&state.qd),
            qdd: list(&state.qdd),
        }
    }
}

/// A motion that an arm can execute, from rest to rest; before it and after it the arm rests.
pub trait Plan: Send + Sync {
    /// How many joints it moves.
    fn joints(&self) -> usize;

    /// s.
    fn duration(&self) -> f64;

    /// Positions, rates and accelerations at `time`, s, each written to a list with an entry for each joint.
    /// Where an acceleration jumps, its value after the jump.
    ///
    /// # Panics
    /// When a list has another length than [`joints`](Self::joints).
    fn write_state(&self, time: f64, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]);

    /// For the arm that planned it, which knows its type.
    #[doc(hidden)]
    fn as_any(&self) -> &dyn Any;
}

/// The planned state at `time`, s.
pub fn state_at(plan: &dyn Plan, time: f64) -> StateList {
    let mut state = StateList {
        q: vec![0.0; plan.joints()],
        qd: vec![0.0; plan.joints()],
        qdd: vec![0.0; plan.joints()],
    };
    plan.write_state(time, &mut state.q, &mut state.qd, &mut state.qdd);
    state
}

impl<const N: usize> Plan for PlannedMotion<N> {
    fn joints(&self) -> usize {
        N
    }

    fn duration(&self) -> f64 {
        Trajectory::duration(self)
    }

    fn write_state(&self, time: f64, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]) {
        let state = self.state(time);
        q.copy_from_slice(state.q.as_slice());
        qd.copy_from_slice(state.qd.as_slice());
        qdd.copy_from_slice(state.qdd.as_slice());
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

pub(crate) fn plan<const N: usize>(
    arm: &AnyArm<N>,
    motion: &Motion,
) -> Result<Box<dyn Plan>, ExperimentError> {
    Ok(Box::new(motion.plan(arm, KNOT_PERIOD)?))
}

/// A plan of an arm of `N` joints.
pub(crate) fn planned<const N: usize>(
    plan: &dyn Plan,
) -> Result<&PlannedMotion<N>, ExperimentError> {
    let planned = plan.as_any().downcast_ref();
    planned.ok_or(ExperimentError::Joints {
        experiment: plan.joints(),
        arm: N,
    })
}
