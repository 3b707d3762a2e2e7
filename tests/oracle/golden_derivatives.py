"""Golden derivatives of the dynamics from Pinocchio, for every arm of arms/, at the arguments in data/<arm>.jsonl.

Builds each arm as golden_pinocchio.py does and shares nothing with the Rust code.
Writes data/<arm>.derivatives.jsonl beside this file: one configuration a line, each matrix row by row, with
    inverse_dynamics_by_q, inverse_dynamics_by_qd               at q, qd, qdd (computeRNEADerivatives)
    forward_dynamics_by_q, forward_dynamics_by_qd               at q, qd, tau (computeABADerivatives)
    forward_dynamics_by_tau                                     the upper triangle, row by row
Numbers are printed so that they read back as the same doubles.

    python3 -m venv .venv && .venv/bin/pip install pin==4.1.0
    .venv/bin/python tests/oracle/golden_derivatives.py
"""

import json
import math
import sys
import tomllib

import numpy as np
import pinocchio as pin

from golden_pinocchio import ARMS, HERE, build, friction_torque


def friction_slope(table, qd):
    """d/dqd of friction_torque's terms, joint by joint."""
    slopes = []
    for row, rate in zip(table["joint"], qd):
        friction = row.get("friction", {})
        smoothing = friction.get("smoothing", 1e-3)
        coulomb = friction.get("coulomb", 0.0) * smoothing**2 / math.hypot(rate, smoothing) ** 3
        slopes.append(friction.get("viscous", 0.0) + coulomb)
    return np.diag(slopes)


def golden(table, model, q, qd, qdd, tau):
    data = model.createData()
    slope = friction_slope(table, qd)
    by_q, by_qd, _ = (np.array(x) for x in pin.computeRNEADerivatives(model, data, q, qd, qdd))
    driving = tau - friction_torque(table, qd)
    accelerated = (np.array(x) for x in pin.computeABADerivatives(model, data, q, qd, driving))
    accelerated_by_q, accelerated_by_qd, by_tau = accelerated
    inverse = np.triu(by_tau) + np.triu(by_tau, 1).T
    return {
        "inverse_dynamics_by_q": by_q.ravel(),
        "inverse_dynamics_by_qd": (by_qd + slope).ravel(),
        "forward_dynamics_by_q": accelerated_by_q.ravel(),
        "forward_dynamics_by_qd": (accelerated_by_qd - inverse @ slope).ravel(),
        "forward_dynamics_by_tau": by_tau[np.triu_indices(model.nv)],
    }


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        table = tomllib.loads(path.read_text())
        model, _ = build(table)
        configurations = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        with open(HERE / "data" / f"{path.stem}.derivatives.jsonl", "w") as out:
            for line in configurations:
                arguments = json.loads(line)
                vectors = [np.array(arguments[name]) for name in ("q", "qd", "qdd", "tau")]
                values = golden(table, model, *vectors)
                json.dump({name: list(map(float, value)) for name, value in values.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {len(configurations)} configurations")


if __name__ == "__main__":
    main()
