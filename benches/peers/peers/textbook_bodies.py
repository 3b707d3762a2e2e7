"""What comes of the motion of the links one by one: poses, Jacobians, energies, the regressor. Most in several ways, as a list
of which the caller keeps the cheapest."""

import casadi as ca

from .textbook import Z, column, frames, joint_pose, number
from .arm import in_motion_alone


def link_poses(arm, q):
    """Rotation by columns, then origin, of every joint's frame."""
    poses, _ = frames(arm, q)
    return ca.vertcat(*(ca.vertcat(ca.vec(ca.densify(r)), ca.densify(p)) for r, p in poses))


def link_jacobians(arm, q):
    """At the origins of the joints' frames (Siciliano et al., section 7.1)."""
    poses, _ = frames(arm, q)
    n, found = len(poses), []
    for i, (_, origin) in enumerate(poses):
        columns = [column(j, r @ Z, origin - p) for j, (r, p) in zip(arm.joints[: i + 1], poses)]
        found.append(ca.horzcat(*columns, ca.SX(6, n - i - 1)))
    return ca.horzcat(*found)


def first_moments(arm, q):
    """Sum of m c over the links, in world axes: by the links' poses, or from the tip to the base."""
    poses, _ = frames(arm, q)
    by_poses = sum((j.mass * (p + r @ number(j.com)) for j, (r, p) in zip(arm.joints, poses)), ca.SX(3, 1))
    moment, mass = ca.SX(3, 1), 0.0
    for i, joint in reversed(list(enumerate(arm.joints))):
        moment, mass = moment + number(joint.mass * joint.com), mass + joint.mass
        rotation, step = joint_pose(joint, q[i])
        moment = rotation @ moment + mass * step
    nested = number(arm.base[:3, :3]) @ moment + mass * number(arm.base[:3, 3])
    return [by_poses, nested]


def centers_of_mass(arm, q):
    return [moment / sum(j.mass for j in arm.joints) for moment in first_moments(arm, q)]


def potential_energies(arm, q):
    return [-number(arm.gravity).T @ moment for moment in first_moments(arm, q)]


def motions(arm, q, qd, qdd):
    """Angular velocity and acceleration, and the origins' velocity and acceleration less gravity, of every link in its own axes
    (Craig, eq. 6.45-6.48)."""
    w, dw, v, a = ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1), number(-arm.base[:3, :3].T @ arm.gravity)
    found = []
    for i, joint in enumerate(arm.joints):
        rotation, p = joint_pose(joint, q[i])
        v = rotation.T @ (v + ca.cross(w, p))
        a = rotation.T @ (a + ca.cross(dw, p) + ca.cross(w, ca.cross(w, p)))
        w, dw = rotation.T @ w, rotation.T @ dw
        if joint.revolute:
            dw = dw + ca.cross(w, Z * qd[i]) + Z * qdd[i]
            w = w + Z * qd[i]
        else:
            a = a + 2 * ca.cross(w, Z * qd[i]) + Z * qdd[i]
            v = v + Z * qd[i]
        found.append((w, dw, v, a))
    return found


def kinetic_energy(arm, q, qd):
    """Of the links one by one, and of the rotors."""
    total = ca.SX(1, 1)
    for i, (joint, (w, _, v, _)) in enumerate(zip(arm.joints, motions(arm, q, qd, ca.SX(len(arm.joints), 1)))):
        v = v + ca.cross(w, number(joint.com))
        total += joint.mass * (v.T @ v) + w.T @ number(joint.inertia) @ w + joint.armature * qd[i] ** 2
    return total / 2


def bias_acceleration(arm, q, qd):
    """The tool's acceleration at q̈ = 0 (Siciliano et al., eq. 3.98), from the links' own axes into the world's."""
    w, dw, _, a = motions(in_motion_alone(arm), q, qd, ca.SX(len(arm.joints), 1))[-1]
    t = number(arm.tool[:3, 3])
    a = a + ca.cross(dw, t) + ca.cross(w, ca.cross(w, t))
    rotation = frames(arm, q)[0][-1][0]
    return ca.vertcat(rotation @ a, rotation @ dw)


def jacobian_rate(arm, q, qd):
    """Each column's rate, by the velocities of its axis and of both its points, in world axes."""
    poses, tool = frames(arm, q)
    w, velocities = ca.SX(3, 1), []
    v, last = ca.SX(3, 1), None
    for i, (joint, (rotation, origin)) in enumerate(zip(arm.joints, poses)):
        axis = rotation @ Z
        if last is not None:
            v = v + ca.cross(w, origin - last)
        if joint.revolute:
            w = w + axis * qd[i]
        else:
            v = v + axis * qd[i]
        velocities.append((w, v))
        last = origin
    v = v + ca.cross(w, tool - last)
    columns = []
    for joint, (rotation, origin), (turning, moving) in zip(arm.joints, poses, velocities):
        axis = rotation @ Z
        rate = ca.cross(turning, axis)
        if joint.revolute:
            columns.append(ca.vertcat(ca.cross(rate, tool - origin) + ca.cross(axis, v - moving), rate))
        else:
            columns.append(ca.vertcat(rate, ca.SX(3, 1)))
    return ca.horzcat(*columns)


# Of a symmetric matrix: which entry a parameter of the regressor is.
PAIRS = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]


def of_vector(v):
    """The matrix L(v) with  I v = L(v) [xx, xy, xz, yy, yz, zz]."""
    rows = ca.SX(3, 6)
    for k, (i, j) in enumerate(PAIRS):
        rows[i, k] = v[j]
        rows[j, k] = v[i]
    return rows


def regressor_by_axes(arm, q, qd, qdd):
    """By virtual work: every joint's axis, carried from link to link, on the wrench that a link's parameters make about its
    frame's origin (Siciliano et al., section 7.2.2)."""
    n = len(arm.joints)
    blocks = [ca.SX(n, 10) for _ in range(n)]
    carried = []
    for i, (joint, (w, dw, _, a)) in enumerate(zip(arm.joints, motions(arm, q, qd, qdd))):
        rotation, p = joint_pose(joint, q[i])
        carried = [(rotation.T @ s, rotation.T @ (u + ca.cross(s, p))) for s, u in carried]
        carried.append((Z, ca.SX(3, 1)) if joint.revolute else (ca.SX(3, 1), Z))
        turn = ca.skew(dw) + w @ w.T - ca.dot(w, w) * ca.SX.eye(3)
        moment = of_vector(dw) + ca.skew(w) @ of_vector(w)
        for j, (s, u) in enumerate(carried):
            first = u.T @ turn + ca.cross(a, s).T
            blocks[i][j, :] = ca.horzcat(ca.dot(u, a), first, s.T @ moment)
    return ca.horzcat(*blocks)


def regressor_by_jacobian(arm, q, qd, qdd):
    """CasADi's derivative of the Newton-Euler torques by the parameters, about the frames' origins."""
    n = len(arm.joints)
    parameters = [ca.SX.sym(f"p{i}", 10) for i in range(n)]
    links = []
    for i, (w, dw, _, a) in enumerate(motions(arm, q, qd, qdd)):
        m, c, rest = parameters[i][0], parameters[i][1:4], parameters[i][4:]
        force = m * a + ca.cross(dw, c) + ca.cross(w, ca.cross(w, c))
        links.append((force, of_vector(dw) @ rest + ca.cross(w, of_vector(w) @ rest) + ca.cross(c, a)))
    f, moment, torque = ca.SX(3, 1), ca.SX(3, 1), []
    for i in reversed(range(n)):
        joint = arm.joints[i]
        rotation, p = joint_pose(joint, q[i])
        f, moment = f + links[i][0], moment + links[i][1]
        torque.append((moment if joint.revolute else f)[2])
        f = rotation @ f
        moment = rotation @ moment + ca.cross(p, f)
    return ca.jacobian(ca.vertcat(*reversed(torque)), ca.vertcat(*parameters))
