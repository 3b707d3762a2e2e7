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
import tomllib

import numpy as np
import pinocchio as pin

from golden_pinocchio import ARMS, HERE, build


def golden(model, q, qd, qdd, tau):
    data = model.createData()
    by_q, by_qd, _ = (np.array(x) for x in pin.computeRNEADerivatives(model, data, q, qd, qdd))
    accelerated = (np.array(x) for x in pin.computeABADerivatives(model, data, q, qd, tau))
    accelerated_by_q, accelerated_by_qd, by_tau = accelerated
    return {
        "inverse_dynamics_by_q": by_q.ravel(),
        "inverse_dynamics_by_qd": by_qd.ravel(),
        "forward_dynamics_by_q": accelerated_by_q.ravel(),
        "forward_dynamics_by_qd": accelerated_by_qd.ravel(),
        "forward_dynamics_by_tau": by_tau[np.triu_indices(model.nv)],
    }


def main():
    for path in sorted(ARMS.glob("*.toml")):
        model, _ = build(tomllib.loads(path.read_text()))
        configurations = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        with open(HERE / "data" / f"{path.stem}.derivatives.jsonl", "w") as out:
            for line in configurations:
                arguments = json.loads(line)
                vectors = [np.array(arguments[name]) for name in ("q", "qd", "qdd", "tau")]
                values = golden(model, *vectors)
                json.dump({name: list(map(float, value)) for name, value in values.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {len(configurations)} configurations")


if __name__ == "__main__":
    main()
