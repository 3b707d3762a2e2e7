//! [`ArmTable`] → [`Model`]: units, physical bounds, names. The last stage that can fail on a user's input.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Matrix3;

use super::convention::{rows, standard_to_modified};
use super::light::{light_links, weight_of};
use super::{Model, name};
use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::table::{
    AngleUnit, ArmTable, Convention, InertiaTable, JointTable, LinkTable, PlacementTable, Vector,
};
use crate::toml_reader::{Key, Located};
use ulna::{Angle, Joint, Link, Placement, TaskRow, TaskRows};

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
        let place = |table: Option<PlacementTable>, xyz_key: &Key| match table {
            Some(table) => placement(&table, self.angle_unit, xyz_key, sink),
            None => Some(Placement::IDENTITY),
        };
        let base = place(self.base, &format::BASE_XYZ);
        let tool = place(self.tool, &format::TOOL_XYZ);
        let weights: Vec<_> = self.joints.iter().flatten().map(weight_of).collect();
        let joints: Option<Vec<_>> = self.joints.map(|rows| {
            rows.iter()
                .map(|row| joint(row, self.angle_unit, sink))
                .collect()
        });
        // Everything has been looked at: only from here on may a fault end the reading.
        let mut joints = joints?.into_iter().collect::<Option<Vec<_>>>()?;
        let mut tool = tool?;
        if self.convention? == Convention::Standard {
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
            joints,
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

fn placement(
    table: &PlacementTable,
    unit: Option<AngleUnit>,
    xyz_key: &Key,
    sink: &Sink,
) -> Option<Placement> {
    let translation = match &table.xyz {
        Some(xyz) => all_within(xyz, xyz_key, sink),
        None => Some([0.0; 3]),
    };
    let angles = match &table.rpy {
        Some(rpy) => all(rpy.each_ref().map(|turn| angle(turn.as_ref()?, unit, sink))),
        None => Some([Angle::default(); 3]),
    };
    Some(Placement {
        rotation: roll_pitch_yaw(angles?),
        translation: translation?,
    })
}

/// R = Rz(yaw) Ry(pitch) Rx(roll).
fn roll_pitch_yaw([roll, pitch, yaw]: [Angle; 3]) -> [[f64; 3]; 3] {
    let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
    let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    let ry = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
    let rz = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    rows(rz * ry * rx)
}

fn joint(row: &JointTable, unit: Option<AngleUnit>, sink: &Sink) -> Option<Joint> {
    let theta = row
        .theta
        .as_ref()
        .and_then(|theta| angle(theta, unit, sink));
    let alpha = row
        .alpha
        .as_ref()
        .and_then(|alpha| angle(alpha, unit, sink));
    let d = row.d.as_ref().and_then(|d| format::D.admit(d, sink));
    let a = row.a.as_ref().and_then(|a| format::A.admit(a, sink));
    let rated = row.rated_torque.as_ref();
    let rated_torque = rated.map(|rated| format::RATED.admit(rated, sink));
    let link = row.link.as_ref().and_then(|row| link(row, sink));
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

fn all_within(numbers: &Vector, key: &Key, sink: &Sink) -> Option<[f64; 3]> {
    let numbers = numbers.each_ref();
    all(numbers.map(|number| key.admit(number.as_ref()?, sink)))
}

/// All values, if none is missing.
fn all<T: Copy + Default, const K: usize>(values: [Option<T>; K]) -> Option<[T; K]> {
    values
        .iter()
        .all(Option::is_some)
        .then(|| values.map(Option::unwrap_or_default))
}

/// The angle in radians, at most one turn either way; `unit` is `None` if it has been reported.
fn angle(number: &Located<f64>, unit: Option<AngleUnit>, sink: &Sink) -> Option<Angle> {
    let value = number.value;
    let (turn, quarter, help) = match unit? {
        AngleUnit::Degrees => (360.0, 90.0, "write an angle within a full turn"),
        AngleUnit::Radians => (
            TAU,
            FRAC_PI_2,
            "if angles are in degrees, write `angle_unit = \"deg\"`",
        ),
    };
    // A little over one turn is rounding.
    if value.abs() > turn * (1.0 + 1e-9) {
        let message = format!("{} is more than a full turn", number.name);
        sink.push(
            Diagnostic::error(number.span.clone(), message)
                .label(format!("must be within -{turn} to {turn}"))
                .help(help),
        );
        return None;
    }
    let quarters = (value / quarter).round();
    let degrees = unit? == AngleUnit::Degrees;
    if degrees && value == quarters * quarter {
        return Some(Angle::from_radians(quarters * FRAC_PI_2));
    }
    let radians = if degrees { value.to_radians() } else { value };
    let exact = Angle::from_radians(radians).quarter_turns().1 == 0.0;
    if !exact && let Some(multiple) = rounded_quarter(value) {
        let (message, help) = if degrees {
            (
                "looks like an angle in radians",
                "if angles are in rad, write `angle_unit = \"rad\"`".to_owned(),
            )
        } else {
            (
                "is a rounded quarter turn, which stays inexact",
                format!("write {multiple:?}"),
            )
        };
        let message = format!("{} {message}", number.name);
        sink.push(Diagnostic::warning(number.span.clone(), message).help(help));
    }
    Some(Angle::from_radians(radians))
}

/// The multiple of π/2 that `value` is a decimal rounding of, such as 1.5708 or -3.14.
fn rounded_quarter(value: f64) -> Option<f64> {
    let multiple = (value / FRAC_PI_2).round() * FRAC_PI_2;
    let rounds = |digits: i32| {
        let scale = 10_f64.powi(digits);
        (multiple * scale).round() / scale == value
    };
    (multiple != 0.0 && (2..=14).any(rounds)).then_some(multiple)
}
