//! Every law over failures for which it was not tuned.
//!
//! A law with coefficients is tuned once, for one lock at one time, and then meets every other joint at every other time of the
//! motion; laws that know neither meet the same. What is counted is the norm of the torque step over the joints that do not lock
//! ([`AssessedCase::before`] without a compensation, [`AssessedCase::after`] with one), the static tool force that is bent for it
//! over the *whole* motion, what is left of the rated torques, and how fast the compensation changes.
//!
//! ```no_run
//! use ulna_study::Scenario;
//! use ulna_study::assess::{Assessment, FailureGrid};
//!
//! # fn run(arm: &ulna::SerialChain<7>) -> Result<(), Box<dyn std::error::Error>> {
//! let scenario = Scenario::load("scenarios/paper_like.toml", &[])?;
//! let grid = FailureGrid::new(arm, &scenario)?;
//! let laws = grid.laws()?;
//! let cases = (0..grid.len()).map(|failure| grid.cases(&laws, failure));
//! let cases = cases.collect::<Result<Vec<_>, _>>()?;
//! for law in &Assessment::new(&laws, cases).laws {
//!     println!("{}: {:.3} at worst", law.law.name(), law.singles.worst_ratio);
//! }
//! # Ok(())
//! # }
//! ```

mod case;
mod grid;
mod ground_truth;
mod law;
mod summary;

pub use case::AssessedCase;
pub use grid::FailureGrid;
pub use ground_truth::{FeltLaw, GroundTruth};
pub use law::{AssessedLaw, Law, Plan, Tactic, Tuning};
pub use summary::{Assessment, LawAssessment, Statistics};
