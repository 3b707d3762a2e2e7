//! [`Campaign`]: a scenario with its arm, case by case.

use ulna_experiments::{Cases, Subject};
use ulna_study::experiment::ExperimentError;
use ulna_study::{LawSet, Scenario};

use crate::{Identity, Row};

/// A scenario's campaign with the arm that makes it.
pub struct Campaign<'a> {
    scenario: &'a Scenario,
    cases: Box<dyn Cases + 'a>,
    identity: Identity,
}

impl<'a> Campaign<'a> {
    /// The campaign of `scenario`, whose arm is `arm`.
    ///
    /// # Errors
    /// When the arm is not the scenario's, or cannot execute its motion.
    pub fn new(arm: &'a dyn Subject, scenario: &'a Scenario) -> Result<Self, ExperimentError> {
        Ok(Self {
            scenario,
            cases: arm.campaign(scenario)?,
            identity: Identity::of(arm, scenario),
        })
    }

    /// What decides a row beside its number.
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// How many cases it has.
    pub fn cases(&self) -> u64 {
        self.scenario.campaign().cases()
    }

    /// The laws that meet each case, in the order of their columns.
    pub fn laws(&self) -> LawSet {
        self.scenario.campaign().laws()
    }

    /// Case number `index`, from 0.
    pub fn row(&self, index: u64) -> Row {
        Row::of(&self.cases.case(index), self.laws())
    }
}
