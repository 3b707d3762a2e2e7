//! A robot description (URDF) in, an arm's table out; or every error at once, each with its place and what to write instead.
//!
//! ```
//! use ulna_urdf::Import;
//!
//! let urdf = r#"<robot name="pendulum">
//!   <link name="ceiling"/>
//!   <joint name="swing" type="continuous">
//!     <parent link="ceiling"/> <child link="rod"/>
//!     <origin xyz="0 0 2"/> <axis xyz="0 1 0"/>
//!   </joint>
//!   <link name="rod">
//!     <inertial>
//!       <origin xyz="0 0 -0.5"/> <mass value="1"/>
//!       <inertia ixx="0.083" ixy="0" ixz="0" iyy="0.083" iyz="0" izz="0.001"/>
//!     </inertial>
//!   </link>
//!   <joint name="mount" type="fixed"> <parent link="rod"/> <child link="bob"/> <origin xyz="0 0 -1"/> </joint>
//!   <link name="bob">
//!     <inertial>
//!       <mass value="3"/> <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
//!     </inertial>
//!   </link>
//! </robot>"#;
//! let arm = Import::new().parse(urdf, "pendulum.urdf")?; // or .load("pendulum.urdf")
//! assert_eq!((arm.base(), arm.tip()), ("ceiling", "bob"));
//! assert_eq!(arm.model().joints()[0].link.mass, 4.0);
//! assert!(arm.notes().iter().any(|note| note.message == "counted with `rod`: `bob`"));
//! // For a file: `ulna check`, build scripts and `arm!` read it.
//! let table: String = arm.table();
//! # assert!(ulna_table::Model::parse(&table, "pendulum.toml").is_ok());
//! # Ok::<(), ulna_table::diagnostics::Diagnostics>(())
//! ```
//!
//! # What becomes of a description
//!
//! - The world is the base link's frame, the tool's frame that of the tip, and `q` that of the description. The base is the root, and the
//!   tip the end of the only chain of joints, if they are not named; of several chains all are listed.
//! - What hangs on by fixed joints counts with the link that moves it. What could move beside the chain is frozen at 0, a joint that mimics
//!   another where that puts it, and counts too; [`Import::drop`] leaves it out. Each is told in a [`Note`].
//! - Names, limits, `effort` (as rated torque), `damping` and `friction` of the joints are kept. Rotors, transmissions, soft limits and
//!   meshes are not read, and no file but the description is opened.
//! - An inertia that no rigid body can have is refused, unless [`Import::accept_inertia`] takes it over. A joint of the chain that is
//!   planar, floating or mimics another is refused.
//! - Gravity, about which a description says nothing, is taken as 9.81 m/s² along -z of the base.
//!
//! # Where to go
//!
//! - [`Import`]: the options, and how to begin.
//! - [`Imported`]: the arm as a table's text, as a [`Description`](ulna_table::Description) and as a [`Model`](ulna_table::Model), its
//!   notes and its warnings.
//! - [`Diagnostics`](ulna_table::diagnostics::Diagnostics): what is wrong; prints as a text for people.
//!
//! There are no features. Build scripts and macros read tables, and never this crate.

mod body;
mod chain;
mod describe;
mod drive;
mod elements;
mod ends;
mod frame;
mod freeze;
mod heading;
mod import;
mod imported;
mod judge;
mod merge;
mod motion;
mod names;
mod normal;
mod note;
mod parallel;
mod read;
mod report;
mod robot;
mod rows;
mod suspicious;
mod task;
mod tidied;
mod tree;
mod xml;

pub use import::Import;
pub use imported::{Imported, ImportedJoint};
pub use note::{Note, NoteKind};
