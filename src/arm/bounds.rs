//! How large what an arm's matrices are made of can be: the sizes that rounding is relative to.

use super::coordinates::PRISMATIC_LIMIT;
use crate::{Joint, JointKind};

/// The least share that a link must have in what its joint carries (see [`own_inertia`] and [`carried_inertia`]).
///
/// M's entries are rounded relative to what a joint carries. The pivots of M, which are never smaller than a link's own share,
/// stay positive while that share is well above the rounding: N + 20 units or so of 1.1e-16.
pub const LEAST_SHARE: f64 = 1e-13;

/// Share of the largest principal moment that counts as rounding in an inertia tensor.
pub const MOMENT_ROUNDING: f64 = 1e-12;
/// Share of the largest principal moment by which the triangle inequality may be missed:
/// moments are printed to three or four digits, and a plate or a thin rod meets it with equality.
pub const TRIANGLE_TOLERANCE: f64 = 1e-3;

/// What a link has of what its joint carries at its farthest, kg·m² (kg for a prismatic joint).
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// [`own_inertia`].
    pub own: f64,
    /// [`carried_inertia`].
    pub carried: f64,
}

impl Share {
    /// That of link `index`, counted from 0.
    pub fn of(joints: &[Joint], index: usize) -> Self {
        Self {
            own: own_inertia(&joints[index]),
            carried: carried_inertia(joints, index, |_| PRISMATIC_LIMIT),
        }
    }

    /// The least that it must have.
    pub fn least(self) -> f64 {
        LEAST_SHARE * self.carried
    }

    /// Whether it has that.
    pub fn is_enough(self) -> bool {
        self.own >= self.least()
    }
}

/// What a link alone adds to its joint's entry of M, with the rotor that drives it: its inertia about the joint's axis, kg·m²
/// (its mass, kg, for a prismatic joint).
pub fn own_inertia(joint: &Joint) -> f64 {
    let [x, y, _] = joint.link.com;
    let link = match joint.kind {
        JointKind::Revolute => joint.link.inertia[2][2] + joint.link.mass * (x * x + y * y),
        JointKind::Prismatic => joint.link.mass,
    };
    link + joint.motor.reflected_inertia()
}

/// An upper bound of joint `index`'s entry of M, kg·m² (kg), over all angles of the joints beyond it:
/// what it [carries](carried_by_links), and its rotor.
pub fn carried_inertia(joints: &[Joint], index: usize, travel: impl Fn(usize) -> f64) -> f64 {
    carried_by_links(joints, index, travel) + joints[index].motor.reflected_inertia()
}

/// The same without the rotor: the inertias of all links beyond, each at its greatest distance.
/// `travel` is how far a prismatic joint is out, m.
pub fn carried_by_links(joints: &[Joint], index: usize, travel: impl Fn(usize) -> f64) -> f64 {
    let (mut carried, mut reach) = (0.0, 0.0);
    for (i, joint) in joints.iter().enumerate().skip(index) {
        if i > index {
            reach += joint.a.abs() + joint.d.abs();
            if joint.kind == JointKind::Prismatic {
                reach += travel(i).abs();
            }
        }
        let link = &joint.link;
        let distance = reach + link.com.iter().map(|x| x.abs()).sum::<f64>();
        carried += match joints[index].kind {
            JointKind::Revolute => {
                let trace = link.inertia[0][0] + link.inertia[1][1] + link.inertia[2][2];
                trace + link.mass * distance * distance
            }
            JointKind::Prismatic => link.mass,
        };
    }
    carried
}
