//! Failures of arms as experiments: scenarios, the search for coefficients, simulation, Section 5 of the paper, and campaigns.

pub mod experiment;
pub mod scenario;
pub mod search;
pub mod simulation;
pub mod tool_path;

pub use scenario::Scenario;
