"""Links, rates, energies, Christoffel's C, and what the tool feels, at the configurations of golden_pinocchio.py.

By Pinocchio all that it has, on the models that golden_pinocchio.py builds; Λ, its inverse of J, w and its gradient by mpmath, with
the arms and the 80 digits of golden_mpmath.py. Shares nothing with the Rust code.
Writes data/<arm>.motion.jsonl beside this file: one configuration a line, with
    link_poses              for each link its origin, and its rotation as a quaternion x, y, z, w
    link_velocities         for each link [v; w] of its origin at qd, world axes: its Jacobian times qd
    center_of_mass
    bias_acceleration       of the tool point at qd, without qdd: classical, world axes
    coriolis_matrix         row by row, of Christoffel's symbols
    kinetic_energy          at q, qd
    potential_energy        at q
    task_space_inertia      the upper triangle over the task's rows
    consistent_inverse      over the task's columns, row by row
    w, gradient             root of det(J J') over the task's rows, and its gradient
The rate of J itself stands in data/<arm>.jsonl. Numbers have 16 digits.

Christoffel's symbols are put together from Pinocchio's derivatives of M. What it has for a Coriolis matrix itself need not be made of
them, of all matrices with the same product with qd; it is, and printed is to how many digits.

    python3 -m venv .venv && .venv/bin/pip install pin==4.1.0 mpmath==1.3.0
    .venv/bin/python tests/oracle/golden_motion.py
"""

import json
import sys
import tomllib

import numpy as np
import pinocchio as pin
from mpmath import det, matrix, mpf, sqrt

import golden_mpmath
from golden_pinocchio import ARMS, HERE, build

ALIGNED = pin.LOCAL_WORLD_ALIGNED


def mass_matrix_derivatives(model, q):
    """[i, j, k]: dM_ij/dq_k, from the analytical derivatives of inverse dynamics at rest."""
    weightless = pin.Model(model)
    weightless.gravity.linear = np.zeros(3)
    data = weightless.createData()
    n = model.nv
    slopes = [pin.computeRNEADerivatives(weightless, data, q, np.zeros(n), np.eye(n)[j])[0].copy() for j in range(n)]
    return np.stack(slopes, axis=1)


def christoffel(model, q, qd):
    d = mass_matrix_derivatives(model, q)
    symbols = 0.5 * (d + d.transpose(0, 2, 1) - d.transpose(2, 1, 0))
    return symbols @ qd


def by_pinocchio(model, frame, q, qd):
    data = model.createData()
    joints = range(1, model.njoints)
    pin.forwardKinematics(model, data, q, qd, np.zeros(model.nv))
    pin.updateFramePlacements(model, data)
    poses = [pin.SE3ToXYZQUAT(data.oMi[joint]) for joint in joints]
    bias = pin.getFrameClassicalAcceleration(model, data, frame, ALIGNED).vector.copy()
    pin.computeJointJacobians(model, data, q)
    jacobians = [pin.getJointJacobian(model, data, joint, ALIGNED) for joint in joints]
    return {
        "link_poses": np.concatenate(poses),
        "link_velocities": np.concatenate([jacobian @ qd for jacobian in jacobians]),
        "center_of_mass": pin.centerOfMass(model, data, q).copy(),
        "bias_acceleration": bias,
        "coriolis_matrix": christoffel(model, q, qd).ravel(),
        "kinetic_energy": pin.computeKineticEnergy(model, data, q, qd),
        "potential_energy": pin.computePotentialEnergy(model, data, q),
    }


def by_mpmath(arm, q):
    jacobian, mass_matrix = arm.jacobian_and_mass_matrix(q)
    mobility = mass_matrix**-1 * jacobian.T
    inertia = (jacobian * mobility) ** -1
    inverse = mobility * inertia
    rows, n = len(arm.task), len(q)

    def squared(q):
        jacobian, _ = arm.jacobian_and_mass_matrix(q)
        return det(jacobian * jacobian.T)

    w = sqrt(squared(q))
    gradient = []
    for i in range(n):
        step = matrix([golden_mpmath.STEP if k == i else 0 for k in range(n)])
        ahead, behind = matrix(q) + step, matrix(q) - step
        gradient.append((squared(ahead) - squared(behind)) / (4 * golden_mpmath.STEP * w))
    return {
        "task_space_inertia": [inertia[r, c] for r in range(rows) for c in range(r, rows)],
        "consistent_inverse": [inverse[i, r] for i in range(n) for r in range(rows)],
        "w": w,
        "gradient": gradient,
    }


def rounded(value):
    if np.ndim(value) == 0:
        return float(f"{float(value):.16g}")
    return [rounded(x) for x in value]


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        table = tomllib.loads(path.read_text())
        (model, frame), arm = build(table), golden_mpmath.Arm(table)
        configurations = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        apart = 0.0
        with open(HERE / "data" / f"{path.stem}.motion.jsonl", "w") as out:
            for line in configurations:
                state = json.loads(line)
                q, qd = np.array(state["q"]), np.array(state["qd"])
                found = by_pinocchio(model, frame, q, qd) | by_mpmath(arm, [mpf(x) for x in state["q"]])
                own = pin.computeCoriolisMatrix(model, model.createData(), q, qd)
                symbols = found["coriolis_matrix"].reshape(own.shape)
                apart = max(apart, np.abs(own - symbols).max() / np.abs(symbols).max())
                json.dump({name: rounded(value) for name, value in found.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {len(configurations)} configurations; Pinocchio's own C differs by {apart:.1g} of the largest entry")


if __name__ == "__main__":
    main()
