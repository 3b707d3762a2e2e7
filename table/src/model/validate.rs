//! [`ArmTable`] → [`Model`]: units, physical bounds, names. The last stage that can fail on a user's input.

use nalgebra::Matrix3;

use super::angle::Angles;
use super::convention::{rows, standard_to_modified};
use super::drive::drive;
use super::joint_names::joint_names;
use super::light::{light_links, weight_of};
use super::placement::placement;
use super::{Model, name};
use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::table::{
    ArmTable, Convention, InertiaTable, JointTable, LinkTable, PlacementTable, Vector,
};
use crate::toml_reader::{Key, Located};
use ulna::{Joint, Link, Placement, TaskRow, TaskRows};

/// Smallest principal moment, kg·m²: a body of a milligram and a millimetre.
const LEAST_MOMENT: f64 = 1e-12;
/// Share of the largest principal moment that counts as rounding when a tensor is tested for positive definiteness.
const MOMENT_ROUNDING: f64 = 1e-12;
/// Share of the largest principal moment by which the triangle inequality may be missed:
/// tables are printed to three or four digits, and a plate or a thin rod meets it with equality.
const TRIANGLE_TOLERANCE: f64 = 1e-3;

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
        if self.convention?.value == Convention::Standard {
            standard_to_modified(&mut joints, &mut tool);
        }
        let light = light_links(&joints, weights);
        if !light.is_empty() {
            light.into_iter().for_each(|error| sink.push(error));
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
            table_hash: String::new(),
        })
    }
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
    let inertia = row.inertia.as_ref().and_then(|row| inertia(row, sink));
    Some(Link {
        mass: mass?,
        com: com?,
        inertia: inertia?,
    })
}

/// The tensor, if a rigid body can have it.
fn inertia(row: &Located<InertiaTable>, sink: &Sink) -> Option<[[f64; 3]; 3]> {
    let moments = all_within(&row.value.moments, &format::XX, sink);
    let products = row.value.products.each_ref();
    let products = products.map(|product| match product {
        Some(product) => format::XY.admit(product, sink),
        None => Some(0.0),
    });
    let [xx, yy, zz] = moments?;
    let [xy, xz, yz] = all(products)?;
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);

    let mut principal = tensor.symmetric_eigenvalues();
    principal.as_mut_slice().sort_by(f64::total_cmp);
    let [least, middle, largest] = principal.into();
    let fault = if least <= largest * MOMENT_ROUNDING || least < LEAST_MOMENT {
        "is not that of a rigid body: it must be positive definite"
    } else if least + middle < largest * (1.0 - TRIANGLE_TOLERANCE) {
        "is not that of a rigid body: no principal moment may exceed the sum of the other two"
    } else {
        return Some(rows(tensor));
    };
    let message = format!("{} {fault}", row.name);
    sink.push(
        Diagnostic::error(row.span.clone(), message)
            .label(format!(
                "principal moments {least:.4e}, {middle:.4e}, {largest:.4e}"
            ))
            .help(
                "give the tensor about the centroid in the link's axes, \
                 products with the tensor's sign: xy is -sum(m x y)",
            ),
    );
    None
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
