//! ∂τ/∂q and ∂τ/∂q̇ in closed form, on composite rigid bodies (Singh, Russell and Wensing, *Efficient Analytical Derivatives of
//! Rigid-Body Dynamics using Spatial Vector Algebra*, IEEE Robotics and Automation Letters, 2022).
//!
//! With S_i the unit twist of joint i, v_i and a_i the velocity and the acceleration of its link, and
//!
//! - Ψ̇_i = v_i × S_i, how the twist is carried along, and Ψ̈_i = a_i × S_i + v_i × Ψ̇_i;
//! - I_i, [C_i](super::velocity_products) and f_i of all links from i on as one body: its inertia, what its velocities do to a twist besides,
//!   and the wrench that its motion takes,
//!
//! the derivatives are, for j ≤ i:
//!
//! - ∂τ_i/∂q_j = S_i · (I_i Ψ̈_j + C_i Ψ̇_j), ∂τ_i/∂q̇_j = S_i · (2 I_i Ψ̇_j + C_i S_j);
//! - ∂τ_j/∂q_i = S_j · (I_i Ψ̈_i + C_i Ψ̇_i + S_i × f_i), ∂τ_j/∂q̇_i = S_j · (2 I_i Ψ̇_i + C_i S_i).
//!
//! All of that is written at joint i, where products with S_i are exchanges of components, and seen from the inertial frame in which
//! the link's point there rests, so that v_i has no linear part. Of the first pair `S_i I_i` and `S_i C_i` travel inward to joint j,
//! and into its inertial frame. Of the second pair what stands right of S_j travels inward as a wrench, which looks alike
//! from every inertial frame, and S_j comes halfway to meet it, at the joint that takes the fewest operations.
//!
//! Differentiating the formulas of τ itself takes 1.4 times the operations, of ssrms as of oblique joints.

use std::iter;

use ulna::JointKind;

use super::body::Body;
use super::chain::{Chain, Group};
use super::friction::friction_slope;
use super::inverse_dynamics::{Motion, Wrench, inward, outward, unloaded};
use super::kinematics::Twist;
use super::mass_matrix::{Momentum, Station, stations};
use super::mass_matrix_derivatives::{momentum_of, twists_at_joints};
use super::outputs::named_rows;
use super::vector::Vec3;
use super::velocity_products::Coriolis;
use crate::graph::Expr;

/// A matrix, by rows.
type Square<'g> = Vec<Vec<Expr<'g>>>;

/// 2 Ψ̇ and Ψ̈ of a joint, at its origin.
struct Drive<'g> {
    twice_rate: Twist<'g>,
    acceleration: Twist<'g>,
}

/// What the links beyond a joint answer with, as one body.
#[derive(Clone, Copy)]
struct Response<'g> {
    /// I S.
    momentum: Momentum<'g>,
    /// S C, a couple.
    couple: Vec3<'g>,
    /// I Ψ̈ + C Ψ̇ + S × f: by how much what the joint transmits changes with its coordinate.
    by_position: Momentum<'g>,
    /// 2 I Ψ̇ + C S: and with its rate.
    by_velocity: Momentum<'g>,
}

/// ∂τ/∂q and ∂τ/∂q̇ of the motion `(qd, qdd)`, by rows. The twists of joints before joint `meeting` travel as far as to it.
pub(crate) fn inverse_dynamics_derivatives<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    qdd: &[Expr<'g>],
    meeting: usize,
) -> [Square<'g>; 2] {
    let [by_position, mut by_velocity] = frictionless(chain, qd, qdd, meeting);
    for (i, slope) in friction_slope(chain, qd).into_iter().enumerate() {
        by_velocity[i][i] = by_velocity[i][i] + slope;
    }
    [by_position, by_velocity]
}

/// The same without friction.
pub(super) fn frictionless<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    qdd: &[Expr<'g>],
    meeting: usize,
) -> [Square<'g>; 2] {
    let n = chain.joint_count();
    let (zero, half) = (chain.graph.constant(0.0), chain.graph.constant(0.5));
    let motions = outward(chain, qd, qdd);
    let pairs = chain.joints.iter().zip(&motions);
    let drives: Vec<Drive<'g>> = pairs
        .map(|(joint, motion)| Drive::new(chain, joint.kind, motion))
        .collect();
    name_drives(&drives);
    let responses = responses(chain, qd, &motions, &drives);
    let twists = twists_at_joints(chain);
    let mut by_position = vec![vec![zero; n]; n];
    let mut by_velocity = vec![vec![zero; n]; n];
    for (j, i) in (0..n).flat_map(|i| (0..=i).map(move |j| (j, i))) {
        let (drive, response) = (&drives[j], &responses[j][i - j]);
        let axis = Twist::unit(chain, chain.joints[j].kind);
        let rate = drive.twice_rate.map(|v| v.scale(half));
        let (momentum, couple) = (&response.momentum, response.couple);
        by_position[i][j] = power(&drive.acceleration, momentum) + rate.angular.dot(couple);
        by_velocity[i][j] = power(&drive.twice_rate, momentum) + axis.angular.dot(couple);
        if j < i {
            let k = meeting.clamp(j, i);
            let twist = twists[k].get(j).unwrap_or(&axis);
            by_position[j][i] = power(twist, &responses[k][i - k].by_position);
            by_velocity[j][i] = power(twist, &responses[k][i - k].by_velocity);
        }
    }
    [
        named_rows(by_position, "tau_q"),
        named_rows(by_velocity, "tau_qd"),
    ]
}

fn name_drives(drives: &[Drive<'_>]) {
    for (drive, i) in drives.iter().zip(1..) {
        let Twist { linear, angular } = drive.twice_rate;
        linear.labelled("psi", |axis| format!("v{axis}_psi_{i}"));
        angular.labelled("psi", |axis| format!("w{axis}_psi_{i}"));
    }
}

impl<'g> Drive<'g> {
    fn new(chain: &Chain<'g>, kind: JointKind, motion: &Motion<'g>) -> Self {
        let (axis, zero) = (chain.axis(), chain.zero());
        let twice = motion.velocity.scale(chain.graph.constant(2.0)).cross(axis);
        // α × z + ω × (ω × z)
        let turned = Vec3(motion.lambda().map(|row| row.0[2]));
        let (twice_rate, acceleration) = match kind {
            JointKind::Revolute => ((zero, twice), (motion.acceleration.cross(axis), turned)),
            JointKind::Prismatic => ((twice, zero), (turned, zero)),
        };
        let twist = |(linear, angular)| Twist { linear, angular };
        Self {
            twice_rate: twist(twice_rate),
            acceleration: twist(acceleration),
        }
    }
}

/// For each joint, the responses of it and of those beyond it, this one first: about its origin, in its group's axes,
/// seen from its own inertial frame.
fn responses<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    motions: &[Motion<'g>],
    drives: &[Drive<'g>],
) -> Vec<Vec<Response<'g>>> {
    let stations = stations(chain);
    let wrenches = inward(chain, motions, unloaded(chain));
    let mut all = Vec::new();
    let mut beyond: Option<Beyond<'g>> = None;
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let (joint, station) = (&chain.joints[i], &stations[i]);
            let kind = joint.kind;
            let [xx, yy, zz, ..] = joint.body.inertia.0;
            let own = joint.body.turn_z(joint.group_from_own);
            let own = Coriolis::of_body(&own, xx + yy + zz, motions[i].velocity);
            own.labelled(i, "_own");
            let (coriolis, passed) = match beyond {
                Some(beyond) => (own.join(beyond.coriolis), beyond.responses),
                None => (own, Vec::new()),
            };
            coriolis.labelled(i, "");
            let response = Response::new(chain, kind, station, &coriolis, &wrenches[i], &drives[i]);
            let mut here = Beyond {
                body: station.composite,
                coriolis,
                responses: iter::once(response).chain(passed).collect(),
            };
            (i..).zip(&here.responses).for_each(|(j, x)| x.named(i, j));
            all.push(here.responses.clone());
            // To the joint before.
            let [along, rest] = joint.legs;
            let mut slide = match kind {
                JointKind::Revolute => chain.zero(),
                JointKind::Prismatic => chain.axis().scale(qd[i]),
            };
            if i == group.joints.start {
                here = here.shift(along, motions[i].velocity.cross(along) + slide);
                here = here.in_parent(group);
                slide = chain.zero();
            }
            if i > 0 {
                here = here.shift(rest, motions[i - 1].velocity.cross(rest) + slide);
            }
            beyond = Some(here);
        }
    }
    all.reverse();
    all
}

/// What is known at a joint of all links beyond it: about its origin, in its group's axes, seen from its own inertial frame.
struct Beyond<'g> {
    /// They as one body.
    body: Body<'g>,
    coriolis: Coriolis<'g>,
    responses: Vec<Response<'g>>,
}

impl<'g> Beyond<'g> {
    /// In the axes of the group before.
    fn in_parent(self, group: &Group<'g>) -> Self {
        let responses = self.responses.into_iter();
        Self {
            body: self.body.turn_z(group.turn).turn_x(group.alpha),
            coriolis: self.coriolis.to_parent(group),
            responses: responses
                .map(|response| response.map(|v| group.to_parent(v)))
                .collect(),
        }
    }

    /// About an origin from which its own lies at `r` and moves away with `velocity`.
    fn shift(self, r: Vec3<'g>, velocity: Vec3<'g>) -> Self {
        let twice_velocity = velocity + velocity;
        let responses = self.responses.into_iter();
        Self {
            body: self.body.shift(r),
            coriolis: self.coriolis.shift(&self.body, r, twice_velocity),
            responses: responses
                .map(|response| response.shift(r, twice_velocity))
                .collect(),
        }
    }
}

impl<'g> Response<'g> {
    fn new(
        chain: &Chain<'g>,
        kind: JointKind,
        Station { composite, momenta }: &Station<'g>,
        coriolis: &Coriolis<'g>,
        wrench: &Wrench<'g>,
        drive: &Drive<'g>,
    ) -> Self {
        let axis = Twist::unit(chain, kind);
        let half = chain.graph.constant(0.5);
        let rate = drive.twice_rate.map(|v| v.scale(half));
        let turned = Momentum {
            linear: axis.angular.cross(wrench.force),
            angular: axis.angular.cross(wrench.moment) + axis.linear.cross(wrench.force),
        };
        let accelerated = momentum_of(composite, &drive.acceleration);
        Self {
            momentum: momenta[0],
            couple: coriolis.couple(kind),
            by_position: sum(sum(accelerated, coriolis.times(&rate)), turned),
            by_velocity: sum(
                momentum_of(composite, &drive.twice_rate),
                coriolis.times(&axis),
            ),
        }
    }

    /// Names what joint `j` answers, as joint `i` has it.
    fn named(&self, i: usize, j: usize) {
        self.couple.named("k", &[i, j]);
        self.by_position.linear.named("fq", &[i, j]);
        self.by_position.angular.named("nq", &[i, j]);
        self.by_velocity.linear.named("fqd", &[i, j]);
        self.by_velocity.angular.named("nqd", &[i, j]);
    }

    /// The same to every vector.
    fn map(self, f: impl Fn(Vec3<'g>) -> Vec3<'g>) -> Self {
        let both = |wrench: Momentum<'g>| Momentum {
            linear: f(wrench.linear),
            angular: f(wrench.angular),
        };
        Self {
            momentum: both(self.momentum),
            couple: f(self.couple),
            by_position: both(self.by_position),
            by_velocity: both(self.by_velocity),
        }
    }

    /// About an origin from which its own lies at `r` and moves away with half of `twice_v`.
    fn shift(self, r: Vec3<'g>, twice_v: Vec3<'g>) -> Self {
        Self {
            momentum: self.momentum.shift(r),
            couple: self.couple + twice_v.cross(self.momentum.linear),
            by_position: self.by_position.shift(r),
            by_velocity: self.by_velocity.shift(r),
        }
    }
}

fn sum<'g>(a: Momentum<'g>, b: Momentum<'g>) -> Momentum<'g> {
    Momentum {
        linear: a.linear + b.linear,
        angular: a.angular + b.angular,
    }
}

/// A twist times a wrench.
fn power<'g>(twist: &Twist<'g>, wrench: &Momentum<'g>) -> Expr<'g> {
    twist.linear.dot(wrench.linear) + twist.angular.dot(wrench.angular)
}
