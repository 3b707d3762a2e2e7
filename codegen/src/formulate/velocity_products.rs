//! What the velocities of the links beyond a joint do to a twist that the joint adds: 2B of Echeandia and Wensing
//! (*Numerical Methods to Compute the Coriolis Matrix and Christoffel Symbols for Rigid-Body Systems*, 2021), without its 6×6 matrices.
//!
//! With ρ from the joint's origin and ρ̇ the velocity there, `P = 2 ∫ρ̇ dm` and `K = 2 ∫(ρ·ρ̇ 1 − ρ̇ ρᵀ) dm` say all of it: a twist
//! `(m, μ)` goes to the force `μ × P` and the moment `K μ`. Twelve numbers that add up over bodies and turn with their axes.
//!
//! ρ̇ is seen from the inertial frame in which the link's own point at the joint rests. Of a body that turns about it
//! `K μ = (2 ∫ρ ρᵀ dm μ) × ω`.

use ulna::JointKind;

use super::body::Body;
use super::chain::Group;
use super::kinematics::Twist;
use super::mass_matrix::Momentum;
use super::matrix::Mat3;
use super::vector::Vec3;
use crate::graph::Expr;

/// P and K of some bodies.
#[derive(Clone, Copy)]
pub(super) struct Coriolis<'g> {
    momentum: Vec3<'g>,
    moment: Mat3<'g>,
}

impl<'g> Coriolis<'g> {
    /// Of a body that turns about the origin with the angular velocity `omega`; `trace` is that of its inertia.
    pub(super) fn of_body(body: &Body<'g>, trace: Expr<'g>, omega: Vec3<'g>) -> Self {
        let [xx, yy, zz, xy, xz, yz] = body.inertia.0.map(|x| x.of(-2.0) * x);
        let (xx, yy, zz) = (xx + trace, yy + trace, zz + trace);
        // 2 ∫ρ ρᵀ dm
        let second = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let columns = second.map(|column| Vec3(column).cross(omega));
        Self {
            momentum: omega.scale(trace.of(2.0)).cross(body.moment),
            moment: Mat3::of_columns(columns),
        }
    }

    /// Names P `ppx_i`, ... and K `kxy_i`, ... of the links from `i` on, or with `_own` behind that.
    pub(super) fn labelled(&self, i: usize, own: &str) {
        let i = i + 1;
        self.momentum
            .labelled("coriolis", |axis| format!("pp{axis}_{i}{own}"));
        for (row, axis) in self.moment.0.iter().zip(["x", "y", "z"]) {
            row.labelled("coriolis", |other| format!("k{axis}{other}_{i}{own}"));
        }
    }

    /// All bodies together.
    pub(super) fn join(self, other: Self) -> Self {
        Self {
            momentum: self.momentum + other.momentum,
            moment: self.moment.plus(other.moment),
        }
    }

    /// In the axes of the group before.
    pub(super) fn to_parent(self, group: &Group<'g>) -> Self {
        Self {
            momentum: group.to_parent(self.momentum),
            moment: self.moment.turn_z(group.turn).turn_x(group.alpha),
        }
    }

    /// About an origin from which its own lies at `r` and moves away with half of `twice_v`. `body` is all of it, about its own origin.
    pub(super) fn shift(self, body: &Body<'g>, r: Vec3<'g>, twice_v: Vec3<'g>) -> Self {
        let momentum = self.momentum + twice_v.scale(body.mass);
        Self {
            momentum,
            moment: self
                .moment
                .plus(Mat3::trace_less_outer(twice_v, body.moment))
                .plus(Mat3::trace_less_outer(momentum, r)),
        }
    }

    /// The wrench that a twist goes to.
    pub(super) fn times(&self, twist: &Twist<'g>) -> Momentum<'g> {
        Momentum {
            linear: twist.angular.cross(self.momentum),
            angular: Vec3(self.moment.0.map(|row| row.dot(twist.angular))),
        }
    }

    /// From the other side: what a joint of this kind along z feels of any twist is that twist times a couple.
    pub(super) fn couple(&self, kind: JointKind) -> Vec3<'g> {
        let [x, y, _] = self.momentum.0;
        match kind {
            JointKind::Revolute => self.moment.0[2],
            JointKind::Prismatic => Vec3([y, -x, x.of(0.0)]),
        }
    }
}
