//! [`TableText`]: a description as a table's text.

mod number;
mod turn;

use std::f64::consts::FRAC_PI_2;
use std::fmt::{self, Write};

use super::Description;
use crate::table::{AngleUnit, Author, Convention};
pub use number::shortest;
use number::{Number, Numbers, Quoted, in_unit};
use turn::roll_pitch_yaw;
use ulna::{Angle, Friction, Joint, JointKind, Limits, Link, Motor, Placement, TaskRow};

/// What a rotation matrix may have taken from its angles by rounding, rad.
const TURN_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A description as a table's text, the same on every machine: its `Display`. [`Description::to_table`] makes it.
///
/// Each number has the fewest digits that give it back, -0 is 0, and of an inertia the upper triangle is written.
#[derive(Clone, Debug)]
pub struct TableText<'d> {
    arm: &'d Description,
    author: Author,
    unit: AngleUnit,
    heading: String,
    remarks: Vec<String>,
}

impl Description {
    /// The description as a table for people, with its angles in `unit`: what [`Model::parse`](super::Model::parse) reads.
    ///
    /// Placements are turned by roll, pitch and yaw, so that a rotation comes back with an error of rounding;
    /// everything else comes back as it is, but that in degrees an angle may be off by its last bit.
    ///
    /// ```
    /// use ulna_table::{AngleUnit, Model};
    ///
    /// # let arm = Model::load("../arms/planar_2r.toml")?;
    /// let text = arm.description().to_table(AngleUnit::Degrees).heading("As measured.").to_string();
    /// assert!(text.starts_with("# As measured.\n\nname = \"planar_2r\"\n"));
    /// assert_eq!(Model::parse(&text, "planar_2r.toml")?.joints(), arm.joints());
    /// # Ok::<(), ulna_table::TableErrors>(())
    /// ```
    pub fn to_table(&self, unit: AngleUnit) -> TableText<'_> {
        TableText {
            arm: self,
            author: Author::Person,
            unit,
            heading: String::new(),
            remarks: Vec::new(),
        }
    }
}

impl<'d> TableText<'d> {
    /// As [`Model::new`](super::Model::new) reads it: rotations as matrices, angles in radians.
    pub(super) fn of_program(arm: &'d Description) -> Self {
        Self {
            author: Author::Program,
            ..arm.to_table(AngleUnit::Radians)
        }
    }

    /// With comments before everything else, a line for each of `text`.
    #[must_use]
    pub fn heading(self, text: &str) -> Self {
        Self {
            heading: text.to_owned(),
            ..self
        }
    }

    /// With a comment beside each joint's header, base first; an empty one is none.
    #[must_use]
    pub fn joint_remarks(self, remarks: &[String]) -> Self {
        Self {
            remarks: remarks.to_vec(),
            ..self
        }
    }
}

impl fmt::Display for TableText<'_> {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        let arm = self.arm;
        let convention = match arm.convention {
            Convention::Modified => "modified",
            Convention::Standard => "standard",
        };
        for line in self.heading.lines() {
            writeln!(text, "{}", Comment(line))?;
        }
        if !self.heading.is_empty() {
            writeln!(text)?;
        }
        writeln!(text, "name = {}", Quoted(&arm.name))?;
        writeln!(text, "convention = \"{convention}\"")?;
        writeln!(text, "angle_unit = \"{}\"", self.unit.word())?;
        writeln!(text, "gravity = {}", Numbers(arm.gravity))?;
        if !arm.allow.is_empty() {
            let names: Vec<_> = arm.allow.iter().map(|lint| lint.name()).collect();
            writeln!(text, "allow = {names:?}")?;
        }
        if arm.joints.is_empty() {
            writeln!(text, "joint = []")?;
        }
        let rows: Vec<_> = arm.task.iter().map(TaskRow::name).collect();
        writeln!(text, "\n[task]\nrows = {rows:?}")?;
        self.write_placement("base", &arm.base, text)?;
        self.write_placement("tool", &arm.tool, text)?;
        if arm.payload {
            writeln!(text, "\n[payload]\nruntime = true")?;
        }
        (0..arm.joints.len()).try_for_each(|index| self.write_joint(index, text))
    }
}

impl TableText<'_> {
    fn write_placement(
        &self,
        name: &str,
        placement: &Placement,
        text: &mut impl Write,
    ) -> fmt::Result {
        if self.author == Author::Person && *placement == Placement::IDENTITY {
            return Ok(());
        }
        writeln!(text, "\n[{name}]")?;
        writeln!(text, "xyz = {}", Numbers(placement.translation))?;
        match self.author {
            Author::Person => {
                let turns = roll_pitch_yaw(&placement.rotation);
                writeln!(
                    text,
                    "rpy = {}",
                    Numbers(turns.map(|turn| self.angle(turn, TURN_ROUNDING)))
                )
            }
            Author::Program => {
                let [x, y, z] = placement.rotation.map(Numbers);
                writeln!(text, "rotation = [{x}, {y}, {z}]")
            }
        }
    }

    fn write_joint(&self, index: usize, text: &mut impl Write) -> fmt::Result {
        let (arm, joint) = (self.arm, &self.arm.joints[index]);
        let kind = match joint.kind {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
        };
        write!(text, "\n[[joint]]")?;
        match self.remarks.get(index) {
            Some(remark) if !remark.is_empty() => writeln!(text, " {}", Comment(remark))?,
            _ => writeln!(text)?,
        }
        if let Some(name) = arm.joint_names.get(index).and_then(Option::as_deref) {
            writeln!(text, "name = {}", Quoted(name))?;
        }
        writeln!(text, "kind = \"{kind}\"")?;
        writeln!(
            text,
            "theta = {}",
            Number(self.angle(joint.theta.radians, 0.0))
        )?;
        writeln!(text, "d = {}", Number(joint.d))?;
        writeln!(text, "a = {}", Number(joint.a))?;
        writeln!(
            text,
            "alpha = {}",
            Number(self.angle(joint.alpha.radians, 0.0))
        )?;
        if let Some(rated) = joint.rated_torque {
            writeln!(text, "rated_torque = {}", Number(rated))?;
        }
        self.write_drive(joint, text)?;
        let Link { mass, com, inertia } = joint.link;
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia.map(|row| row.map(Number));
        writeln!(text, "[joint.link]\nmass = {}", Number(mass))?;
        writeln!(text, "com = {}", Numbers(com))?;
        writeln!(
            text,
            "inertia = {{ xx = {xx}, yy = {yy}, zz = {zz}, xy = {xy}, xz = {xz}, yz = {yz} }}"
        )?;
        if arm.accept_inertia.get(index) == Some(&true) {
            writeln!(text, "accept_inertia = true")?;
        }
        Ok(())
    }

    /// What of the joint's drive a table has to say.
    fn write_drive(&self, joint: &Joint, text: &mut impl Write) -> fmt::Result {
        let (limits, none) = (joint.limits, Limits::NONE);
        if limits != none {
            let parts = [
                ("lower", limits.lower, none.lower),
                ("upper", limits.upper, none.upper),
                ("velocity", limits.velocity, none.velocity),
            ];
            let given = parts.into_iter().filter(|(_, value, none)| value != none);
            let in_unit = |value| match joint.kind {
                JointKind::Revolute => in_unit(value, self.unit, 0.0),
                JointKind::Prismatic => value,
            };
            let given: Vec<_> = given
                .map(|(key, value, _)| format!("{key} = {}", Number(in_unit(value))))
                .collect();
            writeln!(text, "limits = {{ {} }}", given.join(", "))?;
        }
        if joint.motor != Motor::NONE {
            let [inertia, ratio] = [joint.motor.inertia, joint.motor.ratio].map(Number);
            writeln!(text, "motor = {{ inertia = {inertia}, ratio = {ratio} }}")?;
        }
        if joint.friction != Friction::NONE {
            let Friction {
                viscous,
                coulomb,
                smoothing,
            } = joint.friction;
            let [viscous, coulomb, smoothing] = [viscous, coulomb, smoothing].map(Number);
            writeln!(
                text,
                "friction = {{ viscous = {viscous}, coulomb = {coulomb}, smoothing = {smoothing} }}"
            )?;
        }
        Ok(())
    }

    /// An angle of a row or a placement, off by no more than `slack`. A whole number of quarter turns, which stands for exact
    /// sines, is written as one.
    fn angle(&self, radians: f64, slack: f64) -> f64 {
        match (self.unit, Angle::from_radians(radians).quarter_turns()) {
            (AngleUnit::Degrees, (quarters, 0.0)) => quarters as f64 * 90.0,
            (AngleUnit::Radians, (quarters, 0.0)) if self.author == Author::Person => {
                quarters as f64 * FRAC_PI_2
            }
            _ => in_unit(radians, self.unit, slack),
        }
    }
}

/// A line of a comment. What is no letter, sign or space, such as a line's end in a name, becomes a space.
struct Comment<'s>(&'s str);

impl fmt::Display for Comment<'_> {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_char('#')?;
        if !self.0.is_empty() {
            text.write_char(' ')?;
        }
        let shown = |c: char| if c.is_control() { ' ' } else { c };
        self.0.chars().try_for_each(|c| text.write_char(shown(c)))
    }
}
