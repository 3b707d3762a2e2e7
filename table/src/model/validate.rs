//! [`ArmTable`] → [`Model`]: units, physical bounds, names. The last stage that can fail on a user's input.

use super::angle::Angles;
use super::convention::standard_to_modified;
use super::definite::indefinite_at;
use super::drive::drive;
use super::inertia::inertia;
use super::joint_names::joint_names;
use super::light::{light_links, weight_of};
use super::placement::placement;
use super::{Model, name};
use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::table::{ArmTable, Convention, JointTable, LinkTable, PlacementTable, Vector};
use crate::toml_reader::{Key, Located};
use ulna::{Joint, Link, Placement, TaskRow, TaskRows};

impl ArmTable {
    /// The model, without its hash. `None` only if something has been reported to `sink`.
    pub(crate) fn into_model(self, sink: &Sink) -> Option<Model> {
        let name = self.name.and_then(|name| {
            let fault = name::check(&name.value).err();
            if let Some((fault, help)) = fault {
                let message = format!("`name` {fault}");
                sink.push(Diagnostic::error(name.span, message).help(help));
                return None;
            }
            Some(name.value)
        });
        let gravity = match &self.gravity {
            Some(gravity) => all_within(gravity, &format::GRAVITY, sink),
            None => Some([0.0; 3]),
        };
        let joint_count = self.joints.as_ref().map(Vec::len);
        let task = self
            .task
            .and_then(|rows| task_rows(&rows, joint_count, sink));
        let angles = self.angle_unit.map(|unit| Angles {
            unit: unit.value,
            author: self.author,
        });
        let place = |table: Option<PlacementTable>, xyz: &Key| match table {
            Some(table) => placement(&table, angles, xyz, sink),
            None => Some(Placement::IDENTITY),
        };
        let base = place(self.base, &format::BASE_XYZ);
        let tool = place(self.tool, &format::TOOL_XYZ);
        let weights: Vec<_> = self.joints.iter().flatten().map(weight_of).collect();
        let accepted: Vec<_> = self.joints.iter().flatten().map(accepted).collect();
        let joint_names = self
            .joints
            .as_ref()
            .and_then(|rows| joint_names(rows, sink));
        let joints: Option<Vec<_>> = self
            .joints
            .map(|rows| rows.iter().map(|row| joint(row, angles, sink)).collect());
        // Everything has been looked at: only from here on may a fault end the reading.
        let mut joints = joints?.into_iter().collect::<Option<Vec<_>>>()?;
        let mut tool = tool?;
        let convention = self.convention?.value;
        if convention == Convention::Standard {
            standard_to_modified(&mut joints, &mut tool);
        }
        let light = light_links(&joints, weights);
        if !light.is_empty() {
            light.into_iter().for_each(|error| sink.push(error));
            return None;
        }
        if let Some(place) = accepted.iter().flatten().next()
            && let Some(q) = indefinite_at(&joints)
        {
            sink.push(indefinite(place, &q));
            return None;
        }
        Some(Model {
            name: name?,
            gravity: gravity?,
            task: task?,
            base: base?,
            tool,
            payload: self.payload,
            joints,
            joint_names: joint_names?,
            allow: self.allow,
            accept_inertia: accepted.iter().map(Option::is_some).collect(),
            convention,
            angle_unit: angles?.unit,
            table_hash: String::new(),
        })
    }
}

/// The place where a row accepts an inertia that no rigid body can have.
fn accepted(row: &JointTable) -> Option<Located<()>> {
    let accept = row.link.as_ref()?.accept_inertia.as_ref()?;
    accept.value.then(|| accept.place())
}

fn indefinite(place: &Located<()>, q: &[f64]) -> Diagnostic {
    let q: Vec<String> = q.iter().map(|q| format!("{q:.3}")).collect();
    let message = format!(
        "{} leaves the arm without a positive definite mass matrix",
        place.name
    );
    Diagnostic::error(place.span.clone(), message)
        .label(format!("at q = [{}]", q.join(", ")))
        .help("its motion could not be computed there: correct the inertias that are accepted")
}

fn task_rows(
    rows: &Located<Vec<TaskRow>>,
    joint_count: Option<usize>,
    sink: &Sink,
) -> Option<TaskRows> {
    let count = rows.value.len();
    let fault = match joint_count {
        _ if count == 0 => "lists no row".to_owned(),
        Some(joints) if count > joints => {
            let (joints, rows) = (counted(joints, "joint"), counted(count, "row"));
            format!("asks for {rows} of an arm with {joints}")
        }
        _ => return Some(TaskRows::new(&rows.value)),
    };
    // More rows than joints are dependent: w_D would be 0 everywhere.
    let help = "write at least one row, and no more rows than the arm has joints";
    let message = format!("{} {fault}", rows.name);
    sink.push(Diagnostic::error(rows.span.clone(), message).help(help));
    None
}

fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

fn joint(row: &JointTable, angles: Option<Angles>, sink: &Sink) -> Option<Joint> {
    let theta = row.theta.as_ref();
    let theta = theta.and_then(|theta| angles?.admit(theta, sink));
    let alpha = row.alpha.as_ref();
    let alpha = alpha.and_then(|alpha| angles?.admit(alpha, sink));
    let d = row.d.as_ref().and_then(|d| format::D.admit(d, sink));
    let a = row.a.as_ref().and_then(|a| format::A.admit(a, sink));
    let rated = row.rated_torque.as_ref();
    let rated_torque = rated.map(|rated| format::RATED.admit(rated, sink));
    let drive = drive(row, angles, sink);
    let link = row.link.as_ref().and_then(|row| link(row, sink));
    let (limits, motor, friction) = drive?;
    Some(Joint {
        kind: row.kind,
        alpha: alpha?,
        a: a?,
        theta: theta?,
        d: d?,
        rated_torque: match rated_torque {
            Some(rated) => Some(rated?),
            None => None,
        },
        limits,
        motor,
        friction,
        link: link?,
    })
}

fn link(row: &LinkTable, sink: &Sink) -> Option<Link> {
    let mass = row
        .mass
        .as_ref()
        .and_then(|mass| format::MASS.admit(mass, sink));
    let com = row
        .com
        .as_ref()
        .and_then(|com| all_within(com, &format::COM, sink));
    let inertia = inertia(row, sink);
    Some(Link {
        mass: mass?,
        com: com?,
        inertia: inertia?,
    })
}

pub(super) fn all_within(numbers: &Vector, key: &Key, sink: &Sink) -> Option<[f64; 3]> {
    let numbers = numbers.each_ref();
    all(numbers.map(|number| key.admit(number.as_ref()?, sink)))
}

/// All values, if none is missing.
pub(super) fn all<T: Copy + Default, const K: usize>(values: [Option<T>; K]) -> Option<[T; K]> {
    values
        .iter()
        .all(Option::is_some)
        .then(|| values.map(Option::unwrap_or_default))
}
