"""Golden numbers from Pinocchio, for every arm of arms/, or those that are named.

Builds each arm from its table by its own reading of the conventions and shares nothing with the Rust code.
Writes data/<arm>.jsonl beside this file: one configuration a line, with
    q, qd, qdd, tau         the arguments
    pose                    world_from_tool, the first three rows
    jacobian                geometric, tool point, world axes, linear rows first, row by row
    jacobian_rate           sum over i of dJ/dq_i qd_i
    mass_matrix             the upper triangle, row by row
    mass_matrix_rate        sum over i of dM/dq_i qd_i, likewise
    inverse_dynamics        at q, qd, qdd
    bias_force              at q, qd
    gravity_torque          at q
    forward_dynamics        at q, qd, tau
    friction_torque         at qd, of an arm that has friction; it is in inverse_dynamics and forward_dynamics too
Numbers are printed so that they read back as the same doubles.

    python3 -m venv .venv && .venv/bin/pip install pin==4.1.0
    .venv/bin/python tests/oracle/golden_pinocchio.py [ARM...]
"""

import json
import math
import pathlib
import sys
import tomllib

import numpy as np
import pinocchio as pin

CONFIGURATIONS = 100
HERE = pathlib.Path(__file__).resolve().parent
ARMS = HERE.parent.parent / "arms"


def turn(axis, angle):
    return pin.SE3(pin.AngleAxis(angle, np.eye(3)["xyz".index(axis)]).toRotationMatrix(), np.zeros(3))


def shift(x, y, z):
    return pin.SE3(np.eye(3), np.array([x, y, z]))


def placement(table, unit):
    roll, pitch, yaw = (unit * angle for angle in table.get("rpy", [0.0, 0.0, 0.0]))
    return shift(*table.get("xyz", [0.0, 0.0, 0.0])) * turn("z", yaw) * turn("y", pitch) * turn("x", roll)


def build(table):
    """A Pinocchio model with a joint for each row, and its tool frame.

    Pinocchio's joint moves about or along z of its own placement, so what a row has before its motion goes into
    the placement and what it has after it into the pose of the link's frame on the joint.
    """
    unit = {"deg": math.pi / 180.0, "rad": 1.0}[table["angle_unit"]]
    model = pin.Model()
    model.gravity.linear = np.array(table.get("gravity", [0.0, 0.0, 0.0]))
    parent = 0
    joint_from_link = placement(table.get("base", {}), unit)  # of the parent
    for number, row in enumerate(table["joint"], 1):
        screw = turn("z", unit * row["theta"]) * shift(0.0, 0.0, row["d"])
        across = shift(row["a"], 0.0, 0.0) * turn("x", unit * row["alpha"])
        if table["convention"] == "modified":
            before, after = joint_from_link * across * screw, pin.SE3.Identity()
        else:
            before, after = joint_from_link * screw, across
        kind = {"revolute": pin.JointModelRZ, "prismatic": pin.JointModelPZ}[row.get("kind", "revolute")]
        parent = model.addJoint(parent, kind(), before, f"joint{number}")
        link = row["link"]
        entries = {key: link["inertia"].get(key, 0.0) for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
        inertia = np.array(
            [
                [entries["xx"], entries["xy"], entries["xz"]],
                [entries["xy"], entries["yy"], entries["yz"]],
                [entries["xz"], entries["yz"], entries["zz"]],
            ]
        )
        body = pin.Inertia(link["mass"], np.array(link["com"]), inertia)
        model.appendBodyToJoint(parent, body, after)
        joint_from_link = after
    model.armature = np.array([reflected_inertia(row.get("motor", {})) for row in table["joint"]])
    tool = joint_from_link * placement(table.get("tool", {}), unit)
    frame = model.addFrame(pin.Frame("tool", parent, 0, tool, pin.FrameType.OP_FRAME))
    return model, frame


def reflected_inertia(motor):
    return motor.get("inertia", 0.0) * motor.get("ratio", 1.0) ** 2


def friction_torque(table, qd):
    torques = []
    for row, rate in zip(table["joint"], qd):
        friction = row.get("friction", {})
        viscous, coulomb = friction.get("viscous", 0.0), friction.get("coulomb", 0.0)
        torques.append(viscous * rate + coulomb * rate / math.hypot(rate, friction.get("smoothing", 1e-3)))
    return np.array(torques)


def mass_matrix_rate(model, q, qd):
    """From the analytical derivatives of inverse dynamics at rest: d(M e_j)/dq, one unit acceleration after the other."""
    weightless = pin.Model(model)
    weightless.gravity.linear = np.zeros(3)
    data = weightless.createData()
    columns = []
    for j in range(model.nv):
        acceleration = np.eye(model.nv)[j]
        slope, _, _ = pin.computeRNEADerivatives(weightless, data, q, np.zeros(model.nv), acceleration)
        columns.append(slope @ qd)
    return np.array(columns).T


def golden(table, model, frame, state):
    q, qd, qdd, tau = state
    friction = friction_torque(table, qd)
    data = model.createData()
    aligned = pin.LOCAL_WORLD_ALIGNED
    pin.framesForwardKinematics(model, data, q)
    pose = data.oMf[frame].homogeneous[:3]
    jacobian = pin.computeFrameJacobian(model, data, q, frame, aligned)
    pin.computeJointJacobiansTimeVariation(model, data, q, qd)
    pin.updateFramePlacements(model, data)
    jacobian_rate = pin.getFrameJacobianTimeVariation(model, data, frame, aligned)
    upper = np.triu_indices(model.nv)
    mass_matrix = pin.crba(model, data, q)
    values = {
        "q": q,
        "qd": qd,
        "qdd": qdd,
        "tau": tau,
        "pose": pose.ravel(),
        "jacobian": jacobian.ravel(),
        "jacobian_rate": jacobian_rate.ravel(),
        "mass_matrix": mass_matrix[upper],
        "mass_matrix_rate": mass_matrix_rate(model, q, qd)[upper],
        "inverse_dynamics": pin.rnea(model, data, q, qd, qdd) + friction,
        "bias_force": pin.nonLinearEffects(model, data, q, qd),
        "gravity_torque": pin.computeGeneralizedGravity(model, data, q),
        "forward_dynamics": pin.aba(model, data, q, qd, tau - friction),
    }
    if any("friction" in row for row in table["joint"]):
        values["friction_torque"] = friction
    return values


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        table = tomllib.loads(path.read_text())
        model, frame = build(table)
        random = np.random.default_rng(2010)
        prismatic = [row.get("kind", "revolute") == "prismatic" for row in table["joint"]]
        reach = np.where(prismatic, 1.0, np.pi)
        (HERE / "data").mkdir(exist_ok=True)
        with open(HERE / "data" / f"{path.stem}.jsonl", "w") as out:
            for _ in range(CONFIGURATIONS):
                state = random.uniform(-1.0, 1.0, (4, model.nv))
                state[0] *= reach
                values = golden(table, model, frame, state)
                json.dump({name: list(map(float, value)) for name, value in values.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {CONFIGURATIONS} configurations")


if __name__ == "__main__":
    main()
