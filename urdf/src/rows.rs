//! [`rows`]: a chain of joints, each anywhere and about any axis, as rows of modified Denavit–Hartenberg form.
//!
//! Frame i has its z along axis i, its x along the common normal of axes i and i+1, and its origin where that normal leaves
//! axis i (Craig, Introduction to Robotics, 3.4). Where the form leaves a choice it is made so that numbers vanish: parallel
//! axes have their normal where the one before ended (d = 0), the last frame is where the last normal ended (θ = d = 0), and
//! the first where the base puts it (all four are 0). Everything is computed from one joint to the next, in that joint's
//! frame, so that rounding does not gather along the arm.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};
use ulna_table::shortest;

use crate::frame::Frame;
use crate::normal::{Axes, Normal, across};

/// Sine of the angle below which two axes count as parallel, and the angle by which a quarter turn counts as one: what
/// eleven printed digits of π leave. It moves a tool a metre away by a hundredth of a nanometre.
pub(crate) const ROUNDING: f64 = 1e-11;
/// Up to this sine two axes may be taken as parallel, with a warning: what five printed digits of π leave.
pub(crate) const NEARLY_PARALLEL: f64 = 1e-5;
/// Digits beyond this, m or rad, are rounding.
pub(crate) const SLACK: f64 = 1e-13;

/// A joint that moves.
pub(crate) struct Moving {
    /// The joint's frame at q = 0, in that of the joint before; the first one's in the base link's.
    pub(crate) placement: Frame,
    /// The axis in the joint's frame, of length 1.
    pub(crate) axis: Vector3<f64>,
}

/// The chain in modified form.
#[derive(Debug)]
pub(crate) struct Rows {
    /// Where frame 0 is in the base link's frame.
    pub(crate) base: Frame,
    /// One for each joint.
    pub(crate) rows: Vec<Row>,
    /// Where the tip is in the last row's frame.
    pub(crate) tool: Frame,
    /// Where each row's frame is in its joint's frame.
    pub(crate) in_joint_frame: Vec<Frame>,
    /// Axes that were taken as parallel although they are not quite.
    pub(crate) nearly_parallel: Vec<NearlyParallel>,
}

/// A row: rad and m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Row {
    pub(crate) alpha: f64,
    pub(crate) a: f64,
    pub(crate) theta: f64,
    pub(crate) d: f64,
}

/// Two neighbouring axes that are almost parallel, with their common normal far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NearlyParallel {
    /// Index of the second joint.
    pub(crate) joint: usize,
    /// The angle between the axes, rad.
    pub(crate) angle: f64,
    /// How far along an axis the common normal is, m.
    pub(crate) distance: f64,
}

/// The rows of a chain whose tip is at `tool` in the last joint's frame. The axes of joints for which `is_parallel` holds
/// may be taken as parallel to those before them, however far they are from it.
///
/// # Errors
/// Axes that are too far from parallel to be taken as parallel, and too near for rows that keep their digits.
pub(crate) fn rows(
    joints: &[Moving],
    tool: &Frame,
    is_parallel: impl Fn(usize) -> bool,
) -> Result<Rows, Vec<NearlyParallel>> {
    let mut found = Rows {
        base: Frame::identity(),
        rows: Vec::new(),
        tool: *tool,
        in_joint_frame: Vec::new(),
        nearly_parallel: Vec::new(),
    };
    let mut refused = Vec::new();
    // Where the normal before this axis ends on it: its direction in the joint's frame, and how far along the axis.
    let mut normal = Vector3::x();
    let mut foot = 0.0;
    // Twist and length of that normal.
    let mut before = (0.0, 0.0);
    for (index, joint) in joints.iter().enumerate() {
        let axis = joint.axis;
        let from = across(normal, axis);
        let next = joints.get(index + 1).map(|next| {
            let axes = Axes {
                axis,
                point: next.placement.translation,
                next: next.placement.rotation * next.axis,
            };
            Normal::between(&axes, from, foot)
        });
        let (x, start) = match &next {
            Some(next) => (next.direction, next.start),
            None => (from, foot),
        };
        let y = axis.cross(&x);
        let frame = Frame {
            rotation: Matrix3::from_columns(&[x, y, axis]),
            translation: axis * start,
        };
        if index == 0 {
            found.base = joint.placement.times(&frame);
            found.rows.push(Row::default());
        } else {
            let theta = from.cross(&x).dot(&axis).atan2(from.dot(&x));
            found.rows.push(Row {
                alpha: angle(before.0),
                a: tidy(before.1, SLACK),
                theta: angle(theta),
                d: tidy(start - foot, SLACK),
            });
        }
        found.in_joint_frame.push(frame);
        if let (Some(next), Some(joint)) = (next, joints.get(index + 1)) {
            if let Some((angle, distance)) = next.doubt {
                let doubts = if angle <= NEARLY_PARALLEL || is_parallel(index + 1) {
                    &mut found.nearly_parallel
                } else {
                    &mut refused
                };
                doubts.push(NearlyParallel {
                    joint: index + 1,
                    angle,
                    distance,
                });
            }
            normal = joint.placement.rotation.transpose() * next.direction;
            foot = next.end;
            before = (next.twist, next.length);
        }
    }
    if let Some(last) = found.in_joint_frame.last() {
        found.tool = last.inverse().times(tool);
    }
    if refused.is_empty() {
        Ok(found)
    } else {
        Err(refused)
    }
}

/// Whole quarter turns as they are, without what only rounding has added.
fn angle(radians: f64) -> f64 {
    let quarters = (radians / FRAC_PI_2).round() * FRAC_PI_2;
    if (radians - quarters).abs() <= ROUNDING {
        quarters + 0.0
    } else {
        tidy(radians, SLACK)
    }
}

/// The number of the fewest digits within `slack` of `value`; 0 has the fewest.
pub(crate) fn tidy(value: f64, slack: f64) -> f64 {
    if value.abs() <= slack {
        0.0
    } else {
        shortest(value, |short| (short - value).abs() <= slack)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use ulna::internal::random::SplitMix64;

    fn three(random: &mut SplitMix64) -> [f64; 3] {
        std::array::from_fn(|_| random.symmetric())
    }

    fn joint(xyz: [f64; 3], rpy: [f64; 3], axis: [f64; 3]) -> Moving {
        Moving {
            placement: Frame::from_rpy(xyz, rpy),
            axis: Vector3::from(axis).normalize(),
        }
    }

    /// The tip in the base link's frame, joint by joint as the description has it.
    fn as_described(joints: &[Moving], tool: &Frame, q: &[f64]) -> Frame {
        let places = joints.iter().zip(q);
        let last = places.fold(Frame::identity(), |frame, (joint, &q)| {
            let turn = Frame::turned(&joint.axis, q);
            frame.times(&joint.placement).times(&turn)
        });
        last.times(tool)
    }

    /// The same by the rows, T = Rx(alpha) Tx(a) Rz(theta + q) Tz(d).
    fn by_rows(rows: &Rows, q: &[f64]) -> Frame {
        let places = rows.rows.iter().zip(q);
        let last = places.fold(rows.base, |frame, (row, q)| {
            let x = Frame::turned(&Vector3::x(), row.alpha);
            let z = Frame::turned(&Vector3::z(), row.theta + q);
            frame
                .times(&x)
                .times(&Frame::moved(Vector3::x() * row.a))
                .times(&z)
                .times(&Frame::moved(Vector3::z() * row.d))
        });
        last.times(&rows.tool)
    }

    /// The largest difference of the two over some configurations.
    fn difference(joints: &[Moving], tool: &Frame, rows: &Rows) -> f64 {
        let mut numbers = SplitMix64::new(5);
        (0..20)
            .map(|_| {
                let q: Vec<f64> = joints.iter().map(|_| 3.0 * numbers.symmetric()).collect();
                let (one, other) = (as_described(joints, tool, &q), by_rows(rows, &q));
                let turned = (one.rotation - other.rotation).amax();
                turned.max((one.translation - other.translation).amax())
            })
            .fold(0.0, f64::max)
    }

    /// Rows that put the tip where the description does.
    fn checked(joints: &[Moving], tool: &Frame, tolerance: f64) -> Rows {
        let rows = rows(joints, tool, |_| false).unwrap();
        let difference = difference(joints, tool, &rows);
        assert!(difference < tolerance, "{difference:e}\n{rows:#?}");
        rows
    }

    #[test]
    fn axes_anywhere_give_rows_that_move_alike() {
        let mut numbers = SplitMix64::new(1);
        for _ in 0..100 {
            let joints: Vec<Moving> = (0..7)
                .map(|_| {
                    joint(
                        three(&mut numbers),
                        three(&mut numbers),
                        three(&mut numbers),
                    )
                })
                .collect();
            let tool = Frame::from_rpy(three(&mut numbers), three(&mut numbers));
            // A normal may be as far away as 50 m, and cost its digits.
            checked(&joints, &tool, 1e-11);
        }
    }

    #[test]
    fn parallel_and_intersecting_axes_at_quarter_turns_leave_clean_rows() {
        let quarter = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
        let axes = [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let mut numbers = SplitMix64::new(2);
        let mut pick = |count: usize| ((numbers.symmetric() + 1.0) * 0.5 * count as f64) as usize;
        for _ in 0..100 {
            let joints: Vec<Moving> = (0..6)
                .map(|_| {
                    let xyz = std::array::from_fn(|_| [0.0, 0.0, 0.3, -0.125][pick(4)]);
                    let rpy = std::array::from_fn(|_| quarter[pick(4)]);
                    joint(xyz, rpy, axes[pick(4)])
                })
                .collect();
            let tool = Frame::from_rpy([0.1, 0.0, 0.2], [0.0, FRAC_PI_2, 0.0]);
            // Lengths such as sqrt(0.3^2 + 0.125^2) lose what is beyond the digits that are kept.
            let found = checked(&joints, &tool, 1e-12);
            assert_eq!(found.nearly_parallel, []);
            for row in &found.rows {
                let quarters = row.alpha / FRAC_PI_2;
                assert_eq!(quarters, quarters.round(), "{found:#?}");
            }
        }
    }

    #[test]
    fn rounded_quarter_turns_are_taken_as_they_are_written() {
        for (written, whole) in [
            ("1.5708", false),
            ("1.570796", false),
            ("1.57079632679", true),
        ] {
            let written: f64 = written.parse().unwrap();
            let joints = [
                joint([0.0, 0.0, 0.3], [0.0; 3], [0.0, 0.0, 1.0]),
                joint([0.0, 0.1, 0.2], [-written, 0.0, 0.0], [0.0, 0.0, 1.0]),
                joint([0.0, -0.4, 0.0], [written, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ];
            let rows = checked(&joints, &Frame::identity(), 1e-11);
            let expected = if whole { -FRAC_PI_2 } else { -written };
            assert_eq!(rows.rows[1].alpha.abs(), expected.abs());
        }
    }

    /// Rounded half turns: the axes miss being parallel by 7.3e-6, and their normal lies where it should.
    #[test]
    fn axes_that_are_nearly_parallel_with_a_normal_near_by_are_exact() {
        let [half, quarter] = ["3.1416", "1.5708"].map(|written| written.parse().unwrap());
        let joints = [
            joint([0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]),
            joint([0.0, -0.41, 0.0], [0.0, half, 0.0], [0.0, 0.0, 1.0]),
            joint(
                [0.0, 0.2073, -0.0114],
                [-quarter, 0.0, half],
                [0.0, 0.0, 1.0],
            ),
        ];
        let rows = checked(&joints, &Frame::identity(), 1e-11);
        assert_eq!(rows.nearly_parallel, []);
        assert_eq!(rows.rows[1].a, 0.41);
        assert_ne!(rows.rows[1].alpha.abs(), PI);
    }

    #[test]
    fn axes_that_are_nearly_parallel_with_a_normal_far_away_are_told_or_refused() {
        let chain = |angle: f64| {
            [
                joint([0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]),
                joint([0.5, 0.0, 0.0], [0.0, angle, 0.0], [0.0, 0.0, 1.0]),
                joint([0.3, 0.2, 0.1], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ]
        };
        // The normal of these lies 0.5 / angle away.
        let joints = chain(4e-6);
        let found = rows(&joints, &Frame::identity(), |_| false).unwrap();
        let [doubt] = found.nearly_parallel.as_slice() else {
            panic!("{found:#?}");
        };
        assert_eq!(doubt.joint, 1);
        assert!((doubt.angle - 4e-6).abs() < 1e-12);
        assert!((doubt.distance - 0.5 / 4e-6).abs() < 1.0);
        let difference = difference(&joints, &Frame::identity(), &found);
        assert!(difference > 1e-7 && difference < 8e-6, "{difference:e}");

        let refused = rows(&chain(1e-3), &Frame::identity(), |_| false).unwrap_err();
        assert_eq!(refused.len(), 1);
        assert!((refused[0].distance - 500.0).abs() < 1.0);
        // Within 200 times the joints' distance and 49 m they are kept.
        assert_eq!(
            rows(&chain(0.01), &Frame::identity(), |_| false)
                .unwrap_err()
                .len(),
            1
        );
        checked(&chain(0.011), &Frame::identity(), 1e-11);
        checked(&chain(0.03), &Frame::identity(), 1e-12);
    }

    #[test]
    fn one_joint_leaves_everything_to_base_and_tool() {
        let joints = [joint([0.1, 0.2, 0.3], [0.4, 0.5, 0.6], [0.0, 1.0, 0.2])];
        let rows = checked(&joints, &Frame::from_rpy([1.0, 2.0, 3.0], [0.3; 3]), 1e-14);
        assert_eq!(rows.rows, [Row::default()]);
    }
}
