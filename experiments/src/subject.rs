//! [`Subject`]: an arm, whatever its number of joints; [`Held`]: one of `N` joints, which is all that is compiled for each `N`.

use nalgebra::Vector6;
use ulna::{Arm, SerialChain, TaskRows};
use ulna_study::Scenario;
use ulna_study::assess::FailureGrid;
use ulna_study::experiment::{
    AnyArm, Campaign, ExperimentError, ExperimentRunner, LockMechanics, lock_mechanics,
};
use ulna_study::scenario::Motion;

use crate::own::{control, impact, operation, plan, simulation};
use crate::scenario::{Assessing, Cases, Experiments, Failures};
use crate::{
    ControlCycle, Law, LockImpact, Locking, Operation, Plan, Servo, Settings, Simulated, Span,
    StateList,
};

/// An arm to make experiments with. Lists have an entry for each joint, base first; joints are counted from 0;
/// wrenches are `[force; moment]` in world axes at the tool point, N and N·m.
///
/// Lists of another length than [`joints`](Self::joints) are refused as [`ExperimentError::Joints`].
pub trait Subject: Send + Sync {
    /// How many joints it has.
    fn joints(&self) -> usize;

    /// The rows of the Jacobian that make up its task.
    fn task(&self) -> TaskRows;

    /// The arm as data, every number of it: arms of the same text are the same arm, whatever computes them.
    fn data(&self) -> String;

    /// Whether the textbook computes it. Otherwise it is generated code, by the compiler or made of the table at run time, which
    /// have the same formulas and give the same bits.
    fn is_textbook(&self) -> bool;

    /// The arm as a mechanism, at each failure time of `scenario`.
    ///
    /// # Errors
    /// When the arm is not the scenario's, or cannot execute its motion.
    fn mechanics(&self, scenario: &Scenario) -> Result<Vec<LockMechanics>, ExperimentError>;

    /// The arm on the motion of `scenario`, ready for its experiments.
    ///
    /// # Errors
    /// As [`mechanics`](Self::mechanics).
    fn experiments<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Experiments + 'a>, ExperimentError>;

    /// The campaign of `scenario`, case by case.
    ///
    /// # Errors
    /// As [`mechanics`](Self::mechanics).
    fn campaign<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Cases + 'a>, ExperimentError>;

    /// Every failure of the `[assess]` of `scenario`, and the laws that it names, tuned and planned.
    ///
    /// # Errors
    /// As [`mechanics`](Self::mechanics), and when the motion under the tool force cannot be looked at.
    fn assess<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Failures + 'a>, ExperimentError>;

    /// `motion` for this arm.
    ///
    /// # Errors
    /// When it cannot be executed: too fast or too far for a joint, or through a singular pose.
    fn plan(&self, motion: &Motion) -> Result<Box<dyn Plan>, ExperimentError>;

    /// What happens at the joints, structure and all, when those of `locked` stop in a `state` (Eq. 1–12); the lock takes
    /// `wrench_step` from the tool's wrench.
    ///
    /// # Errors
    /// For a joint that the arm does not have.
    fn lock_impact(
        &self,
        state: &StateList,
        locked: &[usize],
        wrench_step: &[f64; 6],
    ) -> Result<LockImpact, ExperimentError>;

    /// One cycle of the suppression controller by `law`: the torques for a `state` of an arm whose tool is to exert `wrench`,
    /// and whose `locked` joints stand still whatever the state says.
    ///
    /// # Errors
    /// For a joint that the arm does not have.
    fn cycle(
        &self,
        law: &Law,
        settings: &Settings,
        state: &StateList,
        wrench: &[f64; 6],
        locked: &[usize],
    ) -> Result<ControlCycle, ExperimentError>;

    /// `plan`, one of this arm's, with a lock in it, ready for searches.
    ///
    /// # Errors
    /// When the plan is another arm's, for a joint that the arm does not have, and when a torque is no finite number.
    fn operation(
        &self,
        plan: &dyn Plan,
        locking: &Locking,
    ) -> Result<Box<dyn Operation>, ExperimentError>;

    /// What the arm really does along `plan`, one of this arm's, while joints are braked and locked under `law`.
    ///
    /// # Errors
    /// As [`operation`](Self::operation), and for numbers that make no run. What goes wrong on the way stands in [`Simulated::ending`].
    fn simulate(
        &self,
        plan: &dyn Plan,
        locking: &Locking,
        law: &Law,
        servo: &Servo,
        span: &Span,
    ) -> Result<Simulated, ExperimentError>;
}

/// An arm of `N` joints.
pub(crate) struct Held<const N: usize> {
    pub(crate) arm: Box<dyn Arm<N> + Send + Sync>,
    /// The same as data, which knows where its links are.
    pub(crate) chain: SerialChain<N>,
    pub(crate) is_textbook: bool,
}

impl<const N: usize> Held<N> {
    fn arm(&self) -> &AnyArm<N> {
        &*self.arm
    }
}

impl<const N: usize> Subject for Held<N> {
    fn joints(&self) -> usize {
        N
    }

    fn task(&self) -> TaskRows {
        self.chain.task
    }

    fn data(&self) -> String {
        format!("{:?}", self.chain)
    }

    fn is_textbook(&self) -> bool {
        self.is_textbook
    }

    fn mechanics(&self, scenario: &Scenario) -> Result<Vec<LockMechanics>, ExperimentError> {
        lock_mechanics(self.arm(), &self.chain, scenario)
    }

    fn experiments<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Experiments + 'a>, ExperimentError> {
        Ok(Box::new(ExperimentRunner::new(self.arm(), scenario)?))
    }

    fn campaign<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Cases + 'a>, ExperimentError> {
        Ok(Box::new(Campaign::new(self.arm(), scenario)?))
    }

    fn assess<'a>(
        &'a self,
        scenario: &'a Scenario,
    ) -> Result<Box<dyn Failures + 'a>, ExperimentError> {
        let grid = FailureGrid::new(self.arm(), scenario)?;
        let laws = grid.laws()?;
        Ok(Box::new(Assessing { grid, laws }))
    }

    fn plan(&self, motion: &Motion) -> Result<Box<dyn Plan>, ExperimentError> {
        plan::plan(self.arm(), motion)
    }

    fn lock_impact(
        &self,
        state: &StateList,
        locked: &[usize],
        wrench_step: &[f64; 6],
    ) -> Result<LockImpact, ExperimentError> {
        impact::of(&self.chain, state, locked, &Vector6::from(*wrench_step))
    }

    fn cycle(
        &self,
        law: &Law,
        settings: &Settings,
        state: &StateList,
        wrench: &[f64; 6],
        locked: &[usize],
    ) -> Result<ControlCycle, ExperimentError> {
        let wrench = Vector6::from(*wrench);
        control::cycle(self.arm(), law, settings, state, &wrench, locked)
    }

    fn operation(
        &self,
        plan: &dyn Plan,
        locking: &Locking,
    ) -> Result<Box<dyn Operation>, ExperimentError> {
        operation::operation(self.arm(), plan, locking)
    }

    fn simulate(
        &self,
        plan: &dyn Plan,
        locking: &Locking,
        law: &Law,
        servo: &Servo,
        span: &Span,
    ) -> Result<Simulated, ExperimentError> {
        simulation::simulate(self.arm(), plan, locking, law, servo, span)
    }
}
