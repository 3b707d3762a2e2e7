"""Derivatives of the torques by composites of bodies, in the links' own frames, on vectors of three.

Spatial vectors are pairs: motions (angular, linear), forces (moment, force), both at the frame's origin.
"""

import casadi as ca
import numpy as np

from .textbook import Z, joint_pose, number, skew

NONE = ca.SX(3, 1)


def cross(motion, other):
    """v × m (Featherstone, eq. 2.31)."""
    (w, u), (a, b) = motion, other
    return ca.cross(w, a), ca.cross(w, b) + ca.cross(u, a)


def dot(motion, force):
    return motion[0].T @ force[0] + motion[1].T @ force[1]


def plus(*pairs):
    return tuple(sum(parts[1:], parts[0]) for parts in zip(*pairs))


def times(factor, pair):
    return factor * pair[0], factor * pair[1]


class Composite:
    """Of a body or several: the spatial inertia I (mass, first moment h, inertia about the origin), the operator
    B = ½ [(v×*) I − I (v×) + (I v) ×̄*] of Singh, Russell and Wensing, and the force f = I a + v ×* I v.

    Of a rigid body, B has two blocks that are not zero: on angular velocities, w× (I − ½ tr I) − h× u× to the moment,
    and −p× to the force, p the linear momentum. The sum of such, seen from anywhere, has them too.
    """

    def __init__(self, mass, first, inertia, moments, momentum, force):
        self.mass, self.first, self.inertia = mass, first, inertia
        self.moments, self.momentum, self.force = moments, momentum, force

    @classmethod
    def of_link(cls, link, velocity, acceleration):
        (w, u), (dw, du) = velocity, acceleration
        c = np.array(link.com)
        about = link.inertia + link.mass * (c @ c * np.eye(3) - np.outer(c, c))
        first, inertia = number(link.mass * c), number(about)
        momentum = link.mass * u + ca.cross(w, first)
        angular = inertia @ w + ca.cross(first, u)
        moments = skew(w) @ number(about - np.trace(about) / 2 * np.eye(3)) - skew(first) @ skew(u)
        force = link.mass * du + ca.cross(dw, first) + ca.cross(w, momentum)
        moment = inertia @ dw + ca.cross(first, du) + ca.cross(w, angular) + ca.cross(u, momentum)
        return cls(link.mass, first, inertia, moments, momentum, (moment, force))

    def on(self, motion):
        """I m."""
        a, b = motion
        return self.inertia @ a + ca.cross(self.first, b), self.mass * b + ca.cross(a, self.first)

    def bee(self, motion):
        """B m."""
        return self.moments @ motion[0], -ca.cross(self.momentum, motion[0])

    def bee_transposed(self, motion):
        """B' m: a moment alone."""
        a, b = motion
        return self.moments.T @ a + ca.cross(self.momentum, b), NONE

    def force_across(self, motion):
        """m ×* f."""
        (a, b), (n, g) = motion, self.force
        return ca.cross(a, n) + ca.cross(b, g), ca.cross(a, g)

    def added_to(self, other, rotation, r):
        """`other` with this, whose frame has this pose in other's."""
        h, p = rotation @ self.first, rotation @ self.momentum
        turned = rotation @ self.inertia @ rotation.T
        sides = skew(r) @ skew(h)
        inertia = turned - sides - sides.T - self.mass * skew(r) @ skew(r)
        moments = rotation @ self.moments @ rotation.T - skew(r) @ skew(p)
        return Composite(
            other.mass + self.mass,
            other.first + h + self.mass * r,
            ca.tril2symm(ca.tril(other.inertia + inertia)),
            other.moments + moments,
            other.momentum + p,
            plus(other.force, carried(self.force, rotation, r)),
        )


def carried(force, rotation, r):
    """A force in the frame before."""
    moment, push = rotation @ force[0], rotation @ force[1]
    return moment + ca.cross(r, push), push


def torque_derivatives(arm, q, qd, qdd):
    """Of the inverse dynamics by q and by q̇, without friction (Singh, Russell, Wensing: Efficient analytical derivatives of
    rigid-body dynamics using spatial vector algebra, 2022).

    One degree of freedom a joint: the rate of its axis is v × S, whether v is the link's or that of the one before.
    """
    n = len(arm.joints)
    axes = [(Z, NONE) if joint.revolute else (NONE, Z) for joint in arm.joints]
    poses = [joint_pose(joint, q[i]) for i, joint in enumerate(arm.joints)]
    velocity, acceleration = (NONE, NONE), (NONE, number(-arm.base[:3, :3].T @ arm.gravity))
    bodies, rates, seconds = [], [], []
    for i, (joint, axis, (rotation, r)) in enumerate(zip(arm.joints, axes, poses)):
        velocity, acceleration = (
            (rotation.T @ angular, rotation.T @ (linear + ca.cross(angular, r))) for angular, linear in (velocity, acceleration)
        )
        rates.append(cross(velocity, axis))
        seconds.append(plus(cross(acceleration, axis), cross(velocity, rates[i])))
        velocity = plus(velocity, times(qd[i], axis))
        acceleration = plus(acceleration, times(qdd[i], axis), times(qd[i], rates[i]))
        bodies.append(Composite.of_link(joint, velocity, acceleration))
    by_q, by_qd = ca.SX(n, n), ca.SX(n, n)
    for i in reversed(range(n)):
        body, axis = bodies[i], axes[i]
        weight, lever = body.on(axis), times(2, body.bee_transposed(axis))
        first = plus(times(2, body.bee(rates[i])), body.on(seconds[i]), body.force_across(axis))
        second = times(2, plus(body.bee(axis), body.on(rates[i])))
        for j in reversed(range(i + 1)):
            by_q[i, j] = dot(rates[j], lever) + dot(seconds[j], weight)
            by_qd[i, j] = dot(axes[j], lever) + 2 * dot(rates[j], weight)
            if j < i:
                by_q[j, i], by_qd[j, i] = dot(axes[j], first), dot(axes[j], second)
            weight, lever, first, second = (carried(force, *poses[j]) for force in (weight, lever, first, second))
        if i > 0:
            bodies[i - 1] = body.added_to(bodies[i - 1], *poses[i])
    return by_q, by_qd
