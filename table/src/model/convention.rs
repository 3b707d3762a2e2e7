//! Standard Denavit–Hartenberg rows, rewritten as modified ones, and back.

use nalgebra::{Matrix3, Vector3};

use super::Description;
use crate::table::Convention;
use ulna::{Angle, Joint, Link, Placement};

impl Description {
    /// The same arm with its rows in the convention `to`: the same motion of every link and of the tool, the same M, J and torques.
    ///
    /// Both forms exist for every chain, because base and tool take what a form has no place for: standard form has no a and α
    /// before the first joint, modified form none behind the last. From modified to standard the first row's go into the
    /// base, from standard to modified the last row's go into the tool. There and back leaves them there.
    #[must_use]
    pub fn in_convention(&self, to: Convention) -> Self {
        let mut arm = self.clone();
        match (self.convention, to) {
            (Convention::Standard, Convention::Modified) => {
                standard_to_modified(&mut arm.joints, &mut arm.tool);
            }
            (Convention::Modified, Convention::Standard) => {
                modified_to_standard(&mut arm.joints, &mut arm.base);
            }
            _ => {}
        }
        arm.convention = to;
        arm
    }
}

/// Rewrites `joints` and `tool` of a chain in standard form, each joint's `a` and `alpha` being its own, in place.
///
/// `T_1 T_2 … = Rz(θ_1)Tz(d_1) · Tx(a_1)Rx(α_1) · Rz(θ_2)Tz(d_2) · …`, and Tx and Rx commute: bracketed anew, the
/// product is that of modified rows in which `a_i`, `α_i` stand in row i+1, with those of the last joint left over
/// for the tool. Frame i of the modified chain is the standard one without `Tx(a_i)Rx(α_i)`, so link i is
/// re-expressed by them.
pub(crate) fn standard_to_modified(joints: &mut [Joint], tool: &mut Placement) {
    let mut before = (Angle::default(), 0.0);
    for joint in joints {
        let own = (joint.alpha, joint.a);
        joint.link = before_shift(joint.link, own);
        (joint.alpha, joint.a) = before;
        before = own;
    }
    *tool = product(&shift(before), tool);
}

/// The other way: the first row's `a`, `alpha` go into the base, and each row takes those of the next.
fn modified_to_standard(joints: &mut [Joint], base: &mut Placement) {
    let mut after = (Angle::default(), 0.0);
    for joint in joints.iter_mut().rev() {
        joint.link = behind_shift(joint.link, after);
        let own = (joint.alpha, joint.a);
        (joint.alpha, joint.a) = after;
        after = own;
    }
    *base = product(base, &shift(after));
}

/// `link` in the frame from which `Tx(a)Rx(alpha)` leads to the one that it is given in.
fn before_shift(link: Link, (alpha, a): (Angle, f64)) -> Link {
    let rotation = rotation_x(alpha);
    Link {
        mass: link.mass,
        com: clean(rotation * Vector3::from(link.com) + Vector3::new(a, 0.0, 0.0)),
        inertia: turned(rotation, link.inertia),
    }
}

/// `link` in the frame to which `Tx(a)Rx(alpha)` leads from the one that it is given in.
fn behind_shift(link: Link, (alpha, a): (Angle, f64)) -> Link {
    let rotation = rotation_x(alpha).transpose();
    Link {
        mass: link.mass,
        com: clean(rotation * (Vector3::from(link.com) - Vector3::new(a, 0.0, 0.0))),
        inertia: turned(rotation, link.inertia),
    }
}

fn turned(rotation: Matrix3<f64>, inertia: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let inertia = rotation * Matrix3::from(inertia).transpose() * rotation.transpose();
    // The upper triangle twice: rounding must not make the tensor unsymmetric.
    rows(Matrix3::from_fn(|i, j| inertia[(i.min(j), i.max(j))]))
}

/// `Tx(a) Rx(alpha)`.
fn shift((alpha, a): (Angle, f64)) -> Placement {
    Placement {
        rotation: rows(rotation_x(alpha)),
        translation: [a, 0.0, 0.0],
    }
}

fn product(first: &Placement, second: &Placement) -> Placement {
    let rotation = Matrix3::from(first.rotation).transpose();
    let point = rotation * Vector3::from(second.translation) + Vector3::from(first.translation);
    Placement {
        rotation: rows(rotation * Matrix3::from(second.rotation).transpose()),
        translation: clean(point),
    }
}

/// Adding 0 turns -0 into 0, so that an exact turn leaves clean numbers.
fn clean(point: Vector3<f64>) -> [f64; 3] {
    [point.x + 0.0, point.y + 0.0, point.z + 0.0]
}

fn rotation_x(alpha: Angle) -> Matrix3<f64> {
    let (sin, cos) = alpha.sin_cos();
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos)
}

/// The rows of `matrix`, -0 made 0.
pub(super) fn rows(matrix: Matrix3<f64>) -> [[f64; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)] + 0.0))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use approx::assert_relative_eq;
    use nalgebra::Matrix4;

    use super::*;
    use ulna::{Friction, JointKind, Limits, Motor};

    fn turn_x(angle: f64) -> Matrix4<f64> {
        Matrix4::from_axis_angle(&Vector3::x_axis(), angle)
    }

    fn turn_z(angle: f64) -> Matrix4<f64> {
        Matrix4::from_axis_angle(&Vector3::z_axis(), angle)
    }

    fn shift(x: f64, z: f64) -> Matrix4<f64> {
        Matrix4::new_translation(&Vector3::new(x, 0.0, z))
    }

    fn joint(theta: f64, d: f64, a: f64, alpha: f64) -> Joint {
        Joint {
            kind: JointKind::Revolute,
            alpha: Angle::from_radians(alpha),
            a,
            theta: Angle::from_radians(theta),
            d,
            rated_torque: Some(1.0),
            limits: Limits {
                lower: -1.0,
                upper: 2.0,
                velocity: 3.0,
            },
            motor: Motor {
                inertia: 1e-4,
                ratio: 100.0,
            },
            friction: Friction {
                viscous: 0.5,
                ..Friction::NONE
            },
            link: Link {
                mass: 2.0,
                com: [0.1, -0.2, 0.3],
                inertia: [[3.0, 0.2, -0.1], [0.2, 2.5, 0.3], [-0.1, 0.3, 2.0]],
            },
        }
    }

    /// Both forms put every link, its inertia and the tool in the same place.
    #[test]
    fn both_conventions_describe_one_mechanism() {
        let standard = [
            joint(0.3, 0.4, 0.5, -0.6),
            joint(-1.3, 0.1, -0.2, FRAC_PI_2),
            joint(0.7, -0.3, 0.25, 1.1),
        ];
        let tool = Placement {
            rotation: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            translation: [0.01, 0.02, 0.03],
        };
        let (mut modified, mut modified_tool) = (standard, tool);
        standard_to_modified(&mut modified, &mut modified_tool);

        let (mut s, mut m) = (Matrix4::identity(), Matrix4::identity());
        for (row_s, row_m) in standard.iter().zip(&modified) {
            let drive = |row: &Joint| (row.rated_torque, row.limits, row.motor, row.friction);
            assert_eq!(drive(row_s), drive(row_m));
            s *= turn_z(row_s.theta.radians) * shift(0.0, row_s.d);
            s *= shift(row_s.a, 0.0) * turn_x(row_s.alpha.radians);
            m *= turn_x(row_m.alpha.radians) * shift(row_m.a, 0.0);
            m *= turn_z(row_m.theta.radians) * shift(0.0, row_m.d);
            let com =
                |frame: &Matrix4<f64>, link: &Link| frame.transform_point(&link.com.into()).coords;
            assert_relative_eq!(com(&s, &row_s.link), com(&m, &row_m.link), epsilon = 1e-14);
            let inertia = |frame: &Matrix4<f64>, link: &Link| {
                let rotation = frame.fixed_view::<3, 3>(0, 0).into_owned();
                rotation * Matrix3::from(link.inertia) * rotation.transpose()
            };
            assert_relative_eq!(
                inertia(&s, &row_s.link),
                inertia(&m, &row_m.link),
                epsilon = 1e-13
            );
        }
        let s = s * tool.isometry().to_homogeneous();
        let m = m * modified_tool.isometry().to_homogeneous();
        assert_relative_eq!(s, m, epsilon = 1e-14);
    }

    #[test]
    fn quarter_turns_leave_exact_numbers() {
        let mut joints = [joint(0.0, 0.0, 0.5, -FRAC_PI_2)];
        let mut tool = Placement::IDENTITY;
        standard_to_modified(&mut joints, &mut tool);
        assert_eq!(joints[0].link.com, [0.6, 0.3, 0.2]);
        assert_eq!(joints[0].link.inertia[1], [-0.1, 2.0, -0.3]);
        assert_eq!(tool.rotation[1], [0.0, 0.0, 1.0]);
    }
}
