"""Golden regressors from Pinocchio, for every arm of arms/, at the configurations of data/<arm>.jsonl.

Writes data/<arm>.regressor.jsonl beside this file: one configuration a line, with
    weights     ten random numbers
    weighted    for each link, its block of the regressor times the weights: N numbers
    regressor   for every twentieth configuration, for each link, its block by columns: 10 N numbers
Pinocchio's parameters are about the origin of the joint's frame, which is the link's frame of modified DH in either convention: a joint turns about,
or slides along, its own z axis, and what follows it in a row of standard DH belongs to the next joint. Its order of the parameters is another.

    .venv/bin/python tests/oracle/golden_pinocchio.py
    .venv/bin/python tests/oracle/golden_regressor.py
"""

import json
import sys
import tomllib

import numpy as np
import pinocchio as pin

from golden_pinocchio import friction_torque, ARMS, HERE, build

FULL = 20
PINOCCHIO = ["m", "mx", "my", "mz", "xx", "xy", "yy", "xz", "yz", "zz"]
OURS = ["m", "mx", "my", "mz", "xx", "xy", "xz", "yy", "yz", "zz"]
ORDER = [PINOCCHIO.index(name) for name in OURS]


def blocks(model, line):
    """The regressor's blocks, N by 10 for each link."""
    arguments = [np.array(line[name]) for name in ("q", "qd", "qdd")]
    regressor = pin.computeJointTorqueRegressor(model, model.createData(), *arguments)
    return [regressor[:, 10 * link : 10 * link + 10][:, ORDER] for link in range(model.nv)]


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        table = tomllib.loads(path.read_text())
        model, _ = build(table)
        random = np.random.default_rng(1991)
        states = [json.loads(line) for line in (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()]
        with open(HERE / "data" / f"{path.stem}.regressor.jsonl", "w") as out:
            for number, state in enumerate(states):
                weights = random.uniform(-1.0, 1.0, 10)
                links = blocks(model, state)
                torque = sum(block @ parameters(model, link) for link, block in enumerate(links))
                drives = model.armature * state["qdd"] + friction_torque(table, state["qd"])
                expected = np.array(state["inverse_dynamics"]) - drives
                assert np.abs(torque - expected).max() <= 1e-11 * max(1.0, np.abs(expected).max())
                values = {"weights": weights.tolist(), "weighted": [(block @ weights).tolist() for block in links]}
                if number % FULL == 0:
                    values["regressor"] = [block.T.ravel().tolist() for block in links]
                json.dump(values, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {len(states)} configurations")


def parameters(model, link):
    return model.inertias[link + 1].toDynamicParameters()[ORDER]


if __name__ == "__main__":
    main()
