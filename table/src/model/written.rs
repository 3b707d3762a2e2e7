//! [`Written`]: a description as a table's text.

use std::fmt::{self, Write};

use super::Description;
use crate::table::Convention;
use ulna::{Friction, Joint, JointKind, Limits, Link, Motor, TaskRow};

/// The description as a table's text, the same on every machine: each number has the fewest digits that give it back,
/// and -0 is 0. Of an inertia the upper triangle is written.
pub(super) struct Written<'d>(pub(super) &'d Description);

impl fmt::Display for Written<'_> {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        let arm = self.0;
        let convention = match arm.convention {
            Convention::Modified => "modified",
            Convention::Standard => "standard",
        };
        writeln!(text, "name = {}", Quoted(&arm.name))?;
        writeln!(text, "convention = \"{convention}\"")?;
        writeln!(text, "angle_unit = \"rad\"")?;
        writeln!(text, "gravity = {}", Numbers(arm.gravity))?;
        if arm.joints.is_empty() {
            writeln!(text, "joint = []")?;
        }
        let rows: Vec<_> = arm.task.iter().map(TaskRow::name).collect();
        writeln!(text, "\n[task]\nrows = {rows:?}")?;
        for (name, placement) in [("base", &arm.base), ("tool", &arm.tool)] {
            let [x, y, z] = placement.rotation.map(Numbers);
            writeln!(text, "\n[{name}]")?;
            writeln!(text, "xyz = {}", Numbers(placement.translation))?;
            writeln!(text, "rotation = [{x}, {y}, {z}]")?;
        }
        if arm.payload {
            writeln!(text, "\n[payload]\nruntime = true")?;
        }
        arm.joints.iter().enumerate().try_for_each(|(i, joint)| {
            let name = arm.joint_names.get(i).and_then(Option::as_deref);
            write_joint(text, name, joint)
        })
    }
}

fn write_joint(text: &mut impl Write, name: Option<&str>, joint: &Joint) -> fmt::Result {
    let kind = match joint.kind {
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
    };
    writeln!(text, "\n[[joint]]")?;
    if let Some(name) = name {
        writeln!(text, "name = {}", Quoted(name))?;
    }
    writeln!(text, "kind = \"{kind}\"")?;
    writeln!(text, "theta = {}", Number(joint.theta.radians))?;
    writeln!(text, "d = {}", Number(joint.d))?;
    writeln!(text, "a = {}", Number(joint.a))?;
    writeln!(text, "alpha = {}", Number(joint.alpha.radians))?;
    if let Some(rated) = joint.rated_torque {
        writeln!(text, "rated_torque = {}", Number(rated))?;
    }
    write_drive(text, joint)?;
    let Link { mass, com, inertia } = joint.link;
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia.map(|row| row.map(Number));
    writeln!(text, "[joint.link]\nmass = {}", Number(mass))?;
    writeln!(text, "com = {}", Numbers(com))?;
    writeln!(
        text,
        "inertia = {{ xx = {xx}, yy = {yy}, zz = {zz}, xy = {xy}, xz = {xz}, yz = {yz} }}"
    )
}

/// What of the joint's drive a table has to say.
fn write_drive(text: &mut impl Write, joint: &Joint) -> fmt::Result {
    let (limits, none) = (joint.limits, Limits::NONE);
    if limits != none {
        let parts = [
            ("lower", limits.lower, none.lower),
            ("upper", limits.upper, none.upper),
            ("velocity", limits.velocity, none.velocity),
        ];
        let given = parts.into_iter().filter(|(_, value, none)| value != none);
        let given: Vec<_> = given
            .map(|(key, value, _)| format!("{key} = {}", Number(value)))
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

/// A number in TOML.
#[derive(Clone, Copy)]
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_nan() {
            return text.write_str("nan");
        }
        write!(text, "{:?}", self.0 + 0.0)
    }
}

/// Three of them.
struct Numbers([f64; 3]);

impl fmt::Display for Numbers {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(Number);
        write!(text, "[{x}, {y}, {z}]")
    }
}

/// A string in TOML, on one line.
struct Quoted<'s>(&'s str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_char('"')?;
        for c in self.0.chars() {
            match c {
                '"' | '\\' => write!(text, "\\{c}")?,
                c if c.is_control() => write!(text, "\\u{:04x}", u32::from(c))?,
                c => text.write_char(c)?,
            }
        }
        text.write_char('"')
    }
}
