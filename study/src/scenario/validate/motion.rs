//! `[motion]`.

use nalgebra::Vector6;

use super::Reader;
use crate::scenario::arm::zero_position;
use crate::scenario::format::bounds::{DURATION, JERK, POSITION, RATE, TOOL_DURATION};
use crate::scenario::format::motion as format;
use crate::scenario::motion::{Motion, Path, range};
use crate::scenario::read::{Angles, List, MotionTable, Numbers, PathTable, ProfileWord};
use ulna::{Joint, JointKind, Limits, Profile, ProfileShape};
use ulna_table::AngleUnit;
use ulna_table::toml_reader::{Bound, Located};

impl MotionTable {
    /// How many joints the motion is for, if its lists agree about it.
    pub(super) fn joint_count(&self) -> Option<usize> {
        let count = self.start.as_ref()?.value.len();
        let agreed = match self.path.as_ref()? {
            PathTable::Joint(goal) => goal.as_ref()?.value.len() == count,
            PathTable::Tool(_) => true,
        };
        agreed.then_some(count)
    }
}

impl Reader<'_> {
    pub(super) fn motion(&self, table: &MotionTable) -> Option<Motion> {
        let start = self.positions(&table.start, table.angles);
        let path = table.path.as_ref().and_then(|path| match path {
            PathTable::Joint(goal) => self.positions(goal, table.angles).map(Path::Joint),
            PathTable::Tool(displacement) => {
                let numbers =
                    self.counted(displacement, 6, "three lengths and a rotation vector")?;
                let numbers = format::DISPLACEMENT.admit_all(numbers, self.sink)?;
                Some(Path::Tool(Vector6::from_column_slice(&numbers)))
            }
        });
        let bound = match table.path {
            Some(PathTable::Tool(_)) => &TOOL_DURATION,
            _ => &DURATION,
        };
        let duration = table.duration.as_ref();
        let duration = duration.and_then(|duration| bound.admit(duration, self.sink));
        let blend = table.blend.as_ref();
        let blend = blend.and_then(|blend| self.blend(blend, duration));
        let profile = self.profile(table, duration, blend);
        let max_velocity = self.velocities(&table.max_velocity);
        let max_acceleration = self.limits(&table.max_acceleration, &RATE);
        let max_jerk = self.limits(&table.max_jerk, &JERK);
        Some(Motion {
            start: start?,
            path: path?,
            profile: profile?,
            max_velocity: max_velocity?,
            max_acceleration: max_acceleration?,
            max_jerk: max_jerk?,
            range: range(self.joints?),
        })
    }

    fn blend(&self, blend: &Located<f64>, duration: Option<f64>) -> Option<f64> {
        if blend.value > 0.0 && duration.is_none_or(|duration| 2.0 * blend.value <= duration) {
            return Some(blend.value);
        }
        let message = format!("{} does not fit twice into the duration", blend.name);
        let most = match duration {
            Some(duration) => format!("above 0 and at most {} s", duration / 2.0),
            None => "above 0 s".to_owned(),
        };
        self.refuse(
            &blend.span,
            message,
            most,
            "the arm speeds up for one blend and slows down for another",
        );
        None
    }

    /// `duration` and `blend` are sound, or `None`.
    fn profile(
        &self,
        table: &MotionTable,
        duration: Option<f64>,
        blend: Option<f64>,
    ) -> Option<Profile> {
        let word = table.profile.unwrap_or_default();
        let jerk_time = table.jerk_time.as_ref();
        if let Some(jerk_time) = jerk_time.filter(|_| word != ProfileWord::SCurve) {
            let message = format!("{} is for an S-curve", jerk_time.name);
            let help = "write `profile = \"s_curve\"` beside it, or leave it out";
            self.refuse(&jerk_time.span, message, "", help);
            return None;
        }
        let (duration, blend) = (duration?, blend?);
        let shape = match (word, jerk_time) {
            (ProfileWord::Trapezoid, _) => ProfileShape::Trapezoid,
            (ProfileWord::Quintic, _) => ProfileShape::Quintic,
            (ProfileWord::SCurve, None) => ProfileShape::s_curve(blend),
            (ProfileWord::SCurve, Some(jerk_time)) => ProfileShape::SCurve {
                jerk_time: jerk_time.value,
            },
        };
        match (Profile::new(duration, blend, shape), jerk_time) {
            (Err(error), Some(jerk_time)) => {
                let message = format!("{} does not fit twice into the blend", jerk_time.name);
                let help = "the acceleration rises for one jerk time and falls for another";
                self.refuse(&jerk_time.span, message, error.to_string(), help);
                None
            }
            (profile, _) => profile.ok(),
        }
    }

    /// q, rad (m).
    fn positions(&self, list: &List, angles: Option<Angles>) -> Option<Vec<f64>> {
        let values = self.in_radians(list, &POSITION)?;
        let joints = self.joints?;
        let zero = |joint: &Joint| match angles? {
            Angles::Dh => Some(zero_position(joint)),
            Angles::Q => Some(0.0),
        };
        let values = values.iter().zip(joints);
        let positions: Option<Vec<f64>> = values
            .map(|(value, joint)| Some(value - zero(joint)?))
            .collect();
        let positions = positions?;
        self.within_limits(list.as_ref()?, &positions)?;
        Some(positions)
    }

    /// Refuses positions that the arm's table rules out, each at its number.
    fn within_limits(&self, list: &Located<Numbers>, positions: &[f64]) -> Option<()> {
        let arm = self.arm?;
        let mut sound = Some(());
        for (index, (joint, q)) in arm.joints().iter().zip(positions).enumerate() {
            let Limits { lower, upper, .. } = joint.limits;
            if joint.limits.beyond(*q) == 0.0 {
                continue;
            }
            let (unit, factor) = match (joint.kind, self.unit) {
                (JointKind::Prismatic, _) => ("m", 1.0),
                (JointKind::Revolute, Some(AngleUnit::Degrees)) => ("deg", 1_f64.to_degrees()),
                (JointKind::Revolute, _) => ("rad", 1.0),
            };
            let place = list.value.get(index).and_then(Option::as_ref);
            let span = place.map_or(&list.span, |number| &number.span);
            let message = format!("{} is beyond the limits of the arm", list.name);
            let shown = |value: f64| (value * factor * 1e6).round() / 1e6;
            let label = format!("q of {} would be {}", arm.joint_called(index), shown(*q));
            let (least, most) = (shown(lower), shown(upper));
            let range = match (lower.is_finite(), upper.is_finite()) {
                (true, true) => format!("{least} to {most}"),
                (true, false) => format!("at least {least}"),
                _ => format!("at most {most}"),
            };
            let help =
                format!("its table allows {range} {unit}, measured from the table's configuration");
            self.refuse(span, message, label, help);
            sound = None;
        }
        sound
    }

    /// Limits of velocities: those of the arm's table too.
    fn velocities(&self, list: &List) -> Option<Vec<f64>> {
        let mut velocities = self.limits(list, &RATE)?;
        for (velocity, joint) in velocities.iter_mut().zip(self.joints?) {
            *velocity = velocity.min(joint.limits.velocity);
        }
        Some(velocities)
    }

    /// Limits of rates; infinite without a list.
    fn limits(&self, list: &List, bound: &Bound) -> Option<Vec<f64>> {
        if list.is_none() {
            return Some(vec![f64::INFINITY; self.joint_count?]);
        }
        self.in_radians(list, bound)
    }

    /// A number for each joint, turned into radians where the joint turns.
    fn in_radians(&self, list: &List, bound: &Bound) -> Option<Vec<f64>> {
        let numbers = self.for_each_joint(list)?;
        let (unit, joints) = (self.unit?, self.joints?);
        let converted: Numbers = numbers
            .iter()
            .zip(joints)
            .map(|(number, joint)| {
                let degrees = unit == AngleUnit::Degrees && joint.kind == JointKind::Revolute;
                let number = number.clone()?;
                Some(number.map(|value| if degrees { value.to_radians() } else { value }))
            })
            .collect();
        bound.admit_all(&converted, self.sink)
    }
}
