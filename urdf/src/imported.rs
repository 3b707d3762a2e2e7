//! [`Imported`]: the arm that came of a description, its table, and what there is to say of both.

use ulna_table::diagnostics::Diagnostics;
use ulna_table::{AngleUnit, Description, Model};

use crate::heading::warned;
use crate::note::Note;

/// An arm that was imported from a robot description.
#[derive(Clone, Debug)]
pub struct Imported {
    pub(crate) description: Description,
    pub(crate) model: Model,
    pub(crate) base: String,
    pub(crate) tip: String,
    pub(crate) joints: Vec<ImportedJoint>,
    pub(crate) notes: Vec<Note>,
    pub(crate) warnings: Diagnostics,
    pub(crate) heading: String,
}

/// Where a joint of the arm comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ImportedJoint {
    /// Its name in the table.
    pub name: String,
    /// Its name in the description.
    pub urdf_name: String,
    /// The line of the description at which it stands, from 1.
    pub line: usize,
    /// The link that it moves.
    pub link: String,
    /// The links that count with that one: fixed to it, or frozen.
    pub merged: Vec<String>,
}

impl Imported {
    /// The arm as numbers, in modified form.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// The arm, examined as every table is.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The link whose frame is the world's.
    pub fn base(&self) -> &str {
        &self.base
    }

    /// The link whose frame is the tool's.
    pub fn tip(&self) -> &str {
        &self.tip
    }

    /// Where the arm's joints come from, base first.
    pub fn joints(&self) -> &[ImportedJoint] {
        &self.joints
    }

    /// What was chosen, merged, frozen, left out and renamed.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// What is allowed in the description, but rarely meant; and inertias that were taken over knowingly.
    pub fn warnings(&self) -> &Diagnostics {
        &self.warnings
    }

    /// The arm's table, for people: angles in radians, with comments that say where everything comes from.
    pub fn table(&self) -> String {
        let remarks: Vec<String> = self.joints.iter().map(remark).collect();
        let table = self.description.to_table(AngleUnit::Radians);
        let heading = format!("{}{}", self.heading, warned(&self.warnings));
        table.heading(&heading).joint_remarks(&remarks).to_string()
    }
}

/// A joint's comment in the table.
fn remark(joint: &ImportedJoint) -> String {
    let mut remark = format!("{} moves {}", joint.urdf_name, joint.link);
    if !joint.merged.is_empty() {
        remark.push_str(&format!(" with {}", joint.merged.join(", ")));
    }
    remark
}
