//! `[base]` and `[tool]`.

use nalgebra::Matrix3;

use super::angle::Angles;
use super::convention::rows;
use super::validate::{all, all_within};
use crate::diagnostics::{Diagnostic, Sink};
use crate::table::{PlacementTable, Turn, Vector};
use crate::toml_reader::{Key, Located};
use ulna::{Angle, Placement};

/// How far the rows of a rotation may be from length 1 and from right angles: nine digits of them, and what rounding makes of more.
const ROTATION_TOLERANCE: f64 = 1e-9;

/// The placement; `angles` is `None` if their unit has been reported.
pub(super) fn placement(
    table: &PlacementTable,
    angles: Option<Angles>,
    lengths: &Key,
    sink: &Sink,
) -> Option<Placement> {
    let translation = match &table.xyz {
        Some(xyz) => all_within(xyz, lengths, sink),
        None => Some([0.0; 3]),
    };
    let rotation = match &table.turn {
        Some(Turn::RollPitchYaw(rpy)) => {
            let turns = rpy.each_ref();
            all(turns.map(|turn| angles?.admit(turn.as_ref()?, sink))).map(roll_pitch_yaw)
        }
        Some(Turn::Matrix(matrix)) => rotation(matrix, sink),
        None => Some(Placement::IDENTITY.rotation),
    };
    Some(Placement {
        rotation: rotation?,
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

/// The matrix as it is given, if it turns and does nothing else.
fn rotation(matrix: &Located<[Vector; 3]>, sink: &Sink) -> Option<[[f64; 3]; 3]> {
    // A number that is none has been reported.
    let row = |row: &Vector| all(row.each_ref().map(|number| Some(number.as_ref()?.value)));
    let given = all(matrix.value.each_ref().map(row))?;
    let rotation = Matrix3::from_fn(|i, j| given[i][j]);
    let off = rotation * rotation.transpose() - Matrix3::identity();
    let orthonormal = off.iter().all(|entry| entry.abs() <= ROTATION_TOLERANCE);
    let (fault, label) = if !orthonormal {
        let off = off.amax();
        let label = format!("R times its transpose is off the identity by {off:.1e}");
        ("its rows must have length 1 and right angles", label)
    } else if rotation.determinant() < 0.0 {
        let label = "the determinant is -1".to_owned();
        ("it mirrors space", label)
    } else {
        return Some(rows(rotation));
    };
    let message = format!("{} is no rotation: {fault}", matrix.name);
    sink.push(
        Diagnostic::error(matrix.span.clone(), message)
            .label(label)
            .help("give the rows of a rotation matrix, to nine digits or more"),
    );
    None
}
