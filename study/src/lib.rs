//! Failures of arms as experiments: scenarios, the search for coefficients, simulation, Section 5 of the paper, and campaigns.
//!
//! ```no_run
//! use ulna_study::Scenario;
//! use ulna_study::experiment::ExperimentRunner;
//!
//! # fn run(arm: &ulna::SerialChain<7>) -> Result<(), Box<dyn std::error::Error>> {
//! let scenario = Scenario::load("scenarios/paper_like.toml", &[])?;
//! for study in ExperimentRunner::new(arm, &scenario)?.run()? {
//!     for case in &study.cases {
//!         let (before, after) = case.healthy_impact(); // N m, over the joints that do not lock
//!         println!("{} at {} s: {before} -> {after}", study.section, study.failure_time);
//!     }
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # Where to go
//!
//! - [`Scenario`]: a file's text, validated; [`scenario`] has what it is made of.
//! - [`search`]: the coefficients k_d of Eq. 21 and 28 by the paper's steps and exactly, and the optimal law, for a motion of your own.
//! - [`simulation`]: what an arm really does when a joint is braked and locked.
//! - [`assess`]: every law over failures for which it was not tuned.
//! - [`laws`]: what the laws are called, here and in scenarios.
//! - [`experiment`]: cases, tables and series of Section 5; campaigns of random motions.
//!
//! There are no features.

pub mod assess;
pub mod experiment;
pub mod laws;
pub mod scenario;
pub mod search;
pub mod simulation;
pub mod tool_path;

pub use laws::{LawName, LawSet};
pub use scenario::Scenario;
