//! [`Places`]: where a table's numbers stand in its text, and what of them a model has no more.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use crate::table::{AngleUnit, ArmTable, Convention, JointTable, LimitsTable, Turn, Vector};
use crate::toml_reader::Located;

/// A place in a table's text.
pub(super) type Span = Range<usize>;

/// Where a table's numbers stand.
pub(crate) struct Places {
    /// The first line of the table, where a missing key belongs.
    pub(super) start: Span,
    /// `convention`, and which it is.
    pub(super) convention: (Span, Option<Convention>),
    /// `angle_unit`, and which it is.
    pub(super) angle_unit: (Span, Option<AngleUnit>),
    /// `gravity`, if the table has it.
    pub(super) gravity: Option<Span>,
    /// Every angle of a row or a placement.
    pub(super) angles: Vec<Located<f64>>,
    /// Those of the joints, base first.
    pub(super) joints: Vec<JointPlaces>,
}

/// Those of a joint and its link.
pub(super) struct JointPlaces {
    /// The row's own `a`, m, whatever the convention.
    pub(super) a: f64,
    /// Its own `alpha`, rad.
    pub(super) alpha: f64,
    /// The limits of position, as they are written.
    pub(super) limits: Vec<Located<f64>>,
    pub(super) mass: Span,
    pub(super) com: Span,
    pub(super) inertia: Span,
    /// The centroid, m, in the frame of the row.
    pub(super) com_given: Vector3<f64>,
    /// The tensor, kg m^2, in the frame of the row.
    pub(super) inertia_given: Matrix3<f64>,
}

impl Places {
    /// Those of `table`. What is missing in it is empty here: it has been reported.
    pub(crate) fn of(table: &ArmTable) -> Self {
        let unit = table.angle_unit.as_ref();
        let convention = table.convention.as_ref();
        let degrees = unit.is_some_and(|unit| unit.value == AngleUnit::Degrees);
        let rows = table.joints.as_deref().unwrap_or_default();
        let turns = [&table.base, &table.tool].into_iter().flatten();
        let turns = turns.filter_map(|placement| match &placement.turn {
            Some(Turn::RollPitchYaw(rpy)) => Some(rpy.iter().flatten()),
            _ => None,
        });
        let of_rows = rows.iter().flat_map(|row| [&row.theta, &row.alpha]);
        let start = table.name.as_ref();
        Self {
            start: start.map(|name| name.span.clone()).unwrap_or_default(),
            convention: (span(convention), convention.map(|found| found.value)),
            angle_unit: (span(unit), unit.map(|found| found.value)),
            gravity: table.gravity.as_ref().and_then(span_of),
            angles: of_rows.flatten().chain(turns.flatten()).cloned().collect(),
            joints: rows
                .iter()
                .map(|row| JointPlaces::of(row, degrees))
                .collect(),
        }
    }

    /// Whether the table is in standard form.
    pub(super) fn is_standard(&self) -> bool {
        self.convention.1 == Some(Convention::Standard)
    }
}

impl JointPlaces {
    fn of(row: &JointTable, degrees: bool) -> Self {
        let link = row.link.as_ref();
        let com = link.and_then(|link| link.com.as_ref());
        let inertia = link.and_then(|link| link.inertia.as_ref());
        let alpha = number(row.alpha.as_ref());
        Self {
            a: number(row.a.as_ref()),
            alpha: if degrees { alpha.to_radians() } else { alpha },
            limits: row.limits.as_ref().map(positions).unwrap_or_default(),
            mass: span(link.and_then(|link| link.mass.as_ref())),
            com: com.and_then(span_of).unwrap_or_default(),
            inertia: span(inertia),
            com_given: com.map_or_else(Vector3::zeros, |com| Vector3::from(numbers(com))),
            inertia_given: inertia.map_or_else(Matrix3::zeros, |inertia| {
                let [xx, yy, zz] = numbers(&inertia.value.moments);
                let [xy, xz, yz] = numbers(&inertia.value.products);
                Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
            }),
        }
    }
}

fn positions(limits: &LimitsTable) -> Vec<Located<f64>> {
    let ends = [&limits.lower, &limits.upper].into_iter();
    ends.flatten().cloned().collect()
}

fn number(located: Option<&Located<f64>>) -> f64 {
    located.map_or(0.0, |number| number.value)
}

fn numbers(vector: &Vector) -> [f64; 3] {
    vector.each_ref().map(|item| number(item.as_ref()))
}

fn span<T>(located: Option<&Located<T>>) -> Span {
    located.map(|found| found.span.clone()).unwrap_or_default()
}

/// From the first of three numbers to the last.
fn span_of(vector: &Vector) -> Option<Span> {
    let [first, _, last] = vector;
    Some(first.as_ref()?.span.start..last.as_ref()?.span.end)
}
