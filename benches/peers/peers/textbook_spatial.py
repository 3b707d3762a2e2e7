"""Derivatives of the torques, and what follows from them, by spatial algebra in the links' own frames."""

import casadi as ca

from .textbook import Z, joint_pose, motion_transform, number, skew, spatial_inertia


def motion_cross(v):
    """v × m of motions [angular; linear] (Featherstone, eq. 2.31)."""
    w, u = skew(v[:3]), skew(v[3:])
    return ca.blockcat([[w, ca.SX(3, 3)], [u, w]])


def force_operator(f):
    """The matrix F with  F m = m ×* f  (Featherstone, eq. 2.32, as an operator on m)."""
    n, g = skew(f[:3]), skew(f[3:])
    return ca.blockcat([[-n, -g], [-g, ca.SX(3, 3)]])


def torque_derivatives(arm, q, qd, qdd):
    """Of the inverse dynamics by q and by q̇ (Singh, Russell, Wensing: Efficient analytical derivatives of rigid-body dynamics
    using spatial vector algebra, 2022, with composites of I and B).

    One degree of freedom a joint: the rate of its axis is v × S, whether v is the link's or that of the one before.
    """
    n = len(arm.joints)
    axes = [ca.vertcat(Z, ca.SX(3, 1)) if j.revolute else ca.vertcat(ca.SX(3, 1), Z) for j in arm.joints]
    transforms = [motion_transform(*joint_pose(j, q[i])) for i, j in enumerate(arm.joints)]
    velocity, acceleration = ca.SX(6, 1), ca.vertcat(ca.SX(3, 1), number(-arm.base[:3, :3].T @ arm.gravity))
    inertias, bees, forces, rates, seconds = [], [], [], [], []
    for i, (joint, axis, transform) in enumerate(zip(arm.joints, axes, transforms)):
        velocity, acceleration = transform @ velocity, transform @ acceleration
        rates.append(motion_cross(velocity) @ axis)
        seconds.append(motion_cross(acceleration) @ axis + motion_cross(velocity) @ rates[i])
        velocity = velocity + axis * qd[i]
        acceleration = acceleration + axis * qdd[i] + rates[i] * qd[i]
        inertia, across = spatial_inertia(joint), motion_cross(velocity)
        momentum = inertia @ velocity
        inertias.append(inertia)
        bees.append((force_operator(momentum) - inertia @ across - across.T @ inertia) / 2)
        forces.append(inertia @ acceleration - across.T @ momentum)
    by_q, by_qd = ca.SX(n, n), ca.SX(n, n)
    for i in reversed(range(n)):
        weight, lever = inertias[i] @ axes[i], bees[i].T @ axes[i]
        first = 2 * bees[i] @ rates[i] + inertias[i] @ seconds[i] + force_operator(forces[i]) @ axes[i]
        second = 2 * (bees[i] @ axes[i] + inertias[i] @ rates[i])
        for j in reversed(range(i + 1)):
            by_q[i, j] = 2 * lever.T @ rates[j] + weight.T @ seconds[j]
            by_qd[i, j] = 2 * (lever.T @ axes[j] + weight.T @ rates[j])
            if j < i:
                by_q[j, i], by_qd[j, i] = axes[j].T @ first, axes[j].T @ second
            back = transforms[j].T
            weight, lever, first, second = back @ weight, back @ lever, back @ first, back @ second
        if i > 0:
            back, there = transforms[i].T, transforms[i]
            inertias[i - 1] += back @ inertias[i] @ there
            bees[i - 1] += back @ bees[i] @ there
            forces[i - 1] += back @ forces[i]
    return by_q, by_qd
