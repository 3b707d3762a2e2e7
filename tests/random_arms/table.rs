//! An arm's table as data, and its TOML: what a failure prints is what a user would have written.

use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// The rows of J that a task may name.
pub(crate) const ROWS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A table. Angles are in degrees here, whatever unit the text has.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) standard: bool,
    pub(crate) in_radians: bool,
    pub(crate) gravity: Option<[f64; 3]>,
    pub(crate) task: Task,
    pub(crate) base: Option<Place>,
    pub(crate) tool: Option<Place>,
    pub(crate) joints: Vec<Joint>,
}

/// The task's rows; an arm of few joints takes the first of them only.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    Position,
    Pose,
    Rows(Vec<&'static str>),
}

#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) xyz: [f64; 3],
    pub(crate) rpy: [f64; 3],
}

#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub(crate) prismatic: bool,
    pub(crate) theta: f64,
    pub(crate) d: f64,
    pub(crate) a: f64,
    pub(crate) alpha: f64,
    /// The rotor's inertia, and its ratio.
    pub(crate) motor: Option<(f64, f64)>,
    /// Viscous, Coulomb's, and what smooths it.
    pub(crate) friction: Option<[f64; 3]>,
    pub(crate) link: Link,
}

#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) mass: f64,
    pub(crate) com: [f64; 3],
    /// `xx`, `yy`, `zz`, `xy`, `xz`, `yz`.
    pub(crate) inertia: [f64; 6],
}

impl Table {
    /// An angle in the text's unit; quarter turns as the doubles nearest to them.
    fn angle(&self, degrees: f64) -> f64 {
        let quarters = degrees / 90.0;
        match self.in_radians {
            false => degrees,
            true if quarters.fract() == 0.0 => quarters * FRAC_PI_2,
            true => degrees.to_radians(),
        }
    }

    fn rows(&self) -> String {
        let joints = self.joints.len();
        let first = |rows: &[&str]| format!("{:?}", &rows[..rows.len().min(joints)]);
        match &self.task {
            Task::Position if joints >= 3 => "\"position\"".to_owned(),
            Task::Pose if joints >= 6 => "\"pose\"".to_owned(),
            Task::Position => first(&ROWS[..3]),
            Task::Pose => first(&ROWS),
            Task::Rows(rows) => first(rows),
        }
    }

    fn write_place(
        &self,
        f: &mut fmt::Formatter<'_>,
        key: &str,
        place: Option<&Place>,
    ) -> fmt::Result {
        let Some(Place { xyz, rpy }) = place else {
            return Ok(());
        };
        let rpy = rpy.map(|angle| self.angle(angle));
        writeln!(f, "\n[{key}]\nxyz = {xyz:?}\nrpy = {rpy:?}")
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let convention = if self.standard {
            "standard"
        } else {
            "modified"
        };
        let unit = if self.in_radians { "rad" } else { "deg" };
        writeln!(f, "name = \"random_arm\"\nconvention = \"{convention}\"")?;
        writeln!(f, "angle_unit = \"{unit}\"")?;
        if let Some(gravity) = self.gravity {
            writeln!(f, "gravity = {gravity:?}")?;
        }
        writeln!(f, "\n[task]\nrows = {}", self.rows())?;
        self.write_place(f, "base", self.base.as_ref())?;
        self.write_place(f, "tool", self.tool.as_ref())?;
        for joint in &self.joints {
            let [theta, alpha] = [joint.theta, joint.alpha].map(|angle| self.angle(angle));
            writeln!(f, "\n[[joint]]")?;
            if joint.prismatic {
                writeln!(f, "kind = \"prismatic\"")?;
            }
            writeln!(f, "theta = {theta:?}\nd = {:?}", joint.d)?;
            writeln!(f, "a = {:?}\nalpha = {alpha:?}", joint.a)?;
            if let Some((inertia, ratio)) = joint.motor {
                writeln!(f, "motor = {{ inertia = {inertia:?}, ratio = {ratio:?} }}")?;
            }
            if let Some([viscous, coulomb, smoothing]) = joint.friction {
                writeln!(
                    f,
                    "friction = {{ viscous = {viscous:?}, coulomb = {coulomb:?}, smoothing = {smoothing:?} }}"
                )?;
            }
            let Link { mass, com, inertia } = &joint.link;
            writeln!(f, "[joint.link]\nmass = {mass:?}\ncom = {com:?}")?;
            let keys = ["xx", "yy", "zz", "xy", "xz", "yz"];
            let entries = keys.iter().zip(inertia).enumerate();
            let written = entries.filter(|(index, (_, value))| *index < 3 || **value != 0.0);
            let written: Vec<_> = written
                .map(|(_, (key, value))| format!("{key} = {value:?}"))
                .collect();
            writeln!(f, "inertia = {{ {} }}", written.join(", "))?;
        }
        Ok(())
    }
}
