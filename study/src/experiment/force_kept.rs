//! [`ForceKept`]: what keeping the tool force leaves to any law at one lock, joint by joint.

use super::list;
use crate::search::{
    Certificate, Fairness, LowerAll, Operation, Optimum, Scope, SearchError, lower_every_joint,
};

/// What any compensation can do that keeps the static tool force: what the norm of the optimum does not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceKept {
    /// Whether all healthy joints can be lowered at once.
    pub healthy: Result<Lowerable, SearchError>,
    /// Whether all joints can, the locked ones too.
    pub all: Result<Lowerable, SearchError>,
    /// The least norm over the healthy joints with none of them worse than without compensation, N·m (N).
    pub no_healthy_joint_worse: Result<f64, SearchError>,
    /// The same with the locked joints' brakes no worse either.
    pub no_joint_worse: Result<f64, SearchError>,
}

/// Whether the steps of some joints can all be lowered at once.
#[derive(Clone, Debug, PartialEq)]
pub enum Lowerable {
    /// No: proven by a wrench ([`Certificate`]).
    None {
        /// The joints that cannot be lowered all at once, counted from 0.
        joints: Vec<usize>,
        /// [`Certificate::margin`], N·m per N.
        margin: f64,
        /// [`Certificate::wrench`], no component above 1.
        wrench: Vec<f64>,
        /// [`Certificate::weights`].
        weights: Vec<f64>,
    },
    /// Yes, each to this part of its step at most, and no law to less.
    All {
        /// The largest of |Δτ̃_i| / |step_i|.
        worst_ratio: f64,
    },
}

impl Lowerable {
    fn new<const N: usize>(operation: &Operation<N>, scope: Scope) -> Result<Self, SearchError> {
        Ok(match lower_every_joint(operation, scope)? {
            LowerAll::Certificate(Certificate {
                wrench,
                weights,
                margin,
                joints,
            }) => Self::None {
                joints,
                margin,
                wrench: wrench.as_slice().to_vec(),
                weights: list(&weights),
            },
            LowerAll::Witness(found) => Self::All {
                worst_ratio: operation.worst_ratio(&found.assessment, scope),
            },
        })
    }
}

impl ForceKept {
    /// At the lock of `operation`.
    pub fn new<const N: usize>(operation: &Operation<N>) -> Self {
        let least = |scope| {
            let fair = Optimum {
                fairness: Fairness::NoJointWorse(scope),
                ..Optimum::default()
            };
            Ok(fair.solve(operation)?.assessment.healthy_impact)
        };
        Self {
            healthy: Lowerable::new(operation, Scope::Healthy),
            all: Lowerable::new(operation, Scope::All),
            no_healthy_joint_worse: least(Scope::Healthy),
            no_joint_worse: least(Scope::All),
        }
    }
}
