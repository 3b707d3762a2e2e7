//! Experiments with an arm whose number of joints is known at run time.
//!
//! In `ulna` and `ulna-study` the number of joints is a parameter of every type. Here it is a number: [`Subject`] is any arm, and what
//! goes in and comes out are plain lists with an entry for each joint.
//!
//! ```
//! use ulna_experiments::{by_table, state_at};
//! use ulna_study::scenario::{Motion, MotionPath};
//! use ulna_table::Model;
//!
//! let model = Model::load("../arms/planar_2r.toml")?;
//! let arm = by_table(&model)?.subject;
//! let profile = ulna::Profile::new(10.0, 2.0, ulna::ProfileShape::Trapezoid)?;
//! let motion = Motion::new(model.joints(), vec![0.2, 0.4], MotionPath::Joint(vec![0.8, 1.2]), profile);
//! let planned = arm.plan(&motion)?;
//! // What the second joint's lock does to both, N m.
//! let impact = arm.lock_impact(&state_at(&*planned, 5.0), &[1], &[0.0; 6])?;
//! assert_eq!(impact.torque.len(), 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where to go
//!
//! - [`by_table`]: the arm of a table, up to [`MAX_JOINTS`] joints; [`CompiledFor::subject`] of [`Copies`]: any [`Arm`](ulna::Arm) of as many.
//! - [`Subject`]: what can be done with it. Of a scenario: its [`Experiments`], its [`Cases`] (a campaign), its [`Failures`] (an assessment).
//!   Of one's own: [`Subject::plan`], [`Subject::lock_impact`], [`Subject::cycle`], [`Subject::operation`] and its searches, [`Subject::simulate`].
//!
//! # Inside
//!
//! Experiments are compiled for each number of joints, and here that is done for all of them: the crate is there so that it is done once,
//! for arms of tables and compiled arms alike, whatever changes in the program.

mod by_table;
mod copies;
mod lists;
mod own;
mod scenario;
mod subject;

pub use by_table::ByTable;
pub use copies::{CompiledFor, Copies, MAX_JOINTS, by_table};
pub use own::control::{ControlCycle, FreeTorqueList, Law, Settings};
pub use own::impact::{JointLoadList, LockImpact};
pub use own::operation::{Assessed, Found, Locking, Operation, Search};
pub use own::plan::{Plan, StateList, state_at};
pub use own::simulation::{Servo, Simulated, SimulatedImpact, SimulatedSample, Span};
pub use scenario::{Cases, Experiments, Failures};
pub use subject::Subject;
