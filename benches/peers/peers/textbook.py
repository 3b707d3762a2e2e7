"""The arm as a CasADi user writes it from a textbook. Structural zeros stay structural, numbers fold as SX folds them."""

import casadi as ca
import numpy as np

Z = ca.SX(ca.DM([0, 0, 1]))


def number(array):
    """A constant; entries that are zero, or would be but for rounding, are absent."""
    array = np.asarray(array, dtype=float)
    return ca.SX(ca.sparsify(ca.DM(np.where(abs(array) < 1e-15, 0.0, array))))


def joint_pose(joint, q):
    """Rotation and translation of a joint's frame in the one before."""
    rotation, translation = number(joint.placement[:3, :3]), number(joint.placement[:3, 3])
    if joint.revolute:
        s, c = ca.sin(q), ca.cos(q)
        return rotation @ ca.sparsify(ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))), translation
    return rotation, translation + rotation @ Z * q


def frames(arm, q):
    """World poses of the joints' frames (rotation, origin), and the tool's origin."""
    rotation, origin, found = number(arm.base[:3, :3]), number(arm.base[:3, 3]), []
    for i, joint in enumerate(arm.joints):
        turn, step = joint_pose(joint, q[i])
        rotation, origin = rotation @ turn, origin + rotation @ step
        found.append((rotation, origin))
    return found, origin + rotation @ number(arm.tool[:3, 3])


def column(joint, axis, arm_to_point):
    if joint.revolute:
        return ca.vertcat(ca.cross(axis, arm_to_point), axis)
    return ca.vertcat(axis, ca.SX(3, 1))


def jacobian(arm, q):
    """Geometric Jacobian at the tool point (Siciliano et al., Robotics, eq. 3.30)."""
    poses, tool = frames(arm, q)
    return ca.horzcat(*(column(j, r @ Z, tool - p) for j, (r, p) in zip(arm.joints, poses)))


def mass_matrix_of_link_jacobians(arm, q):
    """M = sum of m Jp' Jp + Jo' R I R' Jo over the links (Siciliano et al., eq. 7.32)."""
    poses, _ = frames(arm, q)
    mass = ca.SX(len(poses), len(poses))
    for i, (link, (rotation, origin)) in enumerate(zip(arm.joints, poses)):
        centroid = origin + rotation @ number(link.com)
        columns = [column(j, r @ Z, centroid - p) for j, (r, p) in zip(arm.joints[: i + 1], poses)]
        j = ca.horzcat(*columns, ca.SX(6, len(poses) - i - 1))
        turned = rotation.T @ j[3:, :]
        mass += link.mass * j[:3, :].T @ j[:3, :] + turned.T @ number(link.inertia) @ turned
    return mass + rotors(arm)


def skew(v):
    return ca.sparsify(ca.skew(v))


def motion_transform(rotation, translation):
    """Spatial motion vectors [angular; linear] into a frame with this pose (Featherstone, eq. 2.24)."""
    turn = rotation.T
    return ca.blockcat([[turn, ca.SX(3, 3)], [-turn @ skew(translation), turn]])


def spatial_inertia(link):
    """Spatial inertia about the frame's origin (Featherstone, eq. 2.63)."""
    c = skew(number(link.com))
    first = link.mass * c
    return ca.blockcat([[number(link.inertia) + link.mass * c @ c.T, first], [first.T, link.mass * ca.SX.eye(3)]])


def mass_matrix_of_composites(arm, q):
    """M by composite rigid bodies (Featherstone, Rigid Body Dynamics Algorithms, table 6.2)."""
    n = len(arm.joints)
    transforms = [motion_transform(*joint_pose(j, q[i])) for i, j in enumerate(arm.joints)]
    composite = [spatial_inertia(j) for j in arm.joints]
    axes = [ca.vertcat(Z, ca.SX(3, 1)) if j.revolute else ca.vertcat(ca.SX(3, 1), Z) for j in arm.joints]
    mass = ca.SX(n, n)
    for i in reversed(range(n)):
        if i > 0:
            composite[i - 1] += transforms[i].T @ composite[i] @ transforms[i]
        force = composite[i] @ axes[i]
        mass[i, i] = axes[i].T @ force
        for j in reversed(range(i)):
            force = transforms[j + 1].T @ force
            mass[i, j] = mass[j, i] = axes[j].T @ force
    return mass + rotors(arm)


def rotors(arm):
    """What the motors' rotors add to M."""
    return number(np.diag([joint.armature for joint in arm.joints]))


def friction(arm, qd):
    """Viscous, and Coulomb's, smoothed."""
    return ca.vertcat(*(one_friction(joint, qd[i]) for i, joint in enumerate(arm.joints)))


def one_friction(joint, rate):
    torque = ca.SX(1, 1)
    if joint.viscous:
        torque += joint.viscous * rate
    if joint.coulomb:
        torque += joint.coulomb * rate / ca.sqrt(rate**2 + joint.smoothing**2)
    return torque


def inverse_dynamics(arm, q, qd, qdd):
    """Recursive Newton-Euler (Craig, Introduction to Robotics, eq. 6.45-6.53), gravity as the base's acceleration; rotors, friction."""
    w, dw, a = ca.SX(3, 1), ca.SX(3, 1), number(-arm.base[:3, :3].T @ arm.gravity)
    links = []
    for i, joint in enumerate(arm.joints):
        rotation, p = joint_pose(joint, q[i])
        a = rotation.T @ (a + ca.cross(dw, p) + ca.cross(w, ca.cross(w, p)))
        w, dw = rotation.T @ w, rotation.T @ dw
        if joint.revolute:
            dw = dw + ca.cross(w, Z * qd[i]) + Z * qdd[i]
            w = w + Z * qd[i]
        else:
            a = a + 2 * ca.cross(w, Z * qd[i]) + Z * qdd[i]
        c, inertia = number(joint.com), number(joint.inertia)
        force = joint.mass * (a + ca.cross(dw, c) + ca.cross(w, ca.cross(w, c)))
        links.append((rotation, p, force, inertia @ dw + ca.cross(w, inertia @ w) + ca.cross(c, force)))
    f, n, torque = ca.SX(3, 1), ca.SX(3, 1), []
    for joint, (rotation, p, force, moment) in reversed(list(zip(arm.joints, links))):
        f, n = f + force, n + moment
        torque.append((n if joint.revolute else f)[2])
        f = rotation @ f
        n = rotation @ n + ca.cross(p, f)
    return ca.vertcat(*reversed(torque)) + rotors(arm) @ qdd + friction(arm, qd)
