"""Golden numbers of arms that carry a payload, from Pinocchio: for every arm of arms/ whose table has one at run time.

Writes data/<arm>.payload.jsonl beside this file, a line for each of data/<arm>.jsonl, whose q, qd, qdd and tau are the arguments:
    mass, com, inertia      a random body in the tool's frame; the inertia about its centroid, xx, xy, xz, yy, yz, zz
    mass_matrix             with it: the upper triangle, row by row
    inverse_dynamics        at q, qd, qdd
    gravity_torque          at q
    forward_dynamics        at q, qd, tau

    .venv/bin/python tests/oracle/golden_payload.py
"""

import json
import tomllib

import numpy as np
import pinocchio as pin

from golden_pinocchio import ARMS, HERE, build, friction_torque

XX_XY_XZ_YY_YZ_ZZ = np.triu_indices(3)


def random_body(random):
    """A box of random sides and mass, turned and put somewhere at random."""
    mass = random.uniform(0.0, 20.0)
    com = random.uniform(-0.4, 0.4, 3)
    squares = random.uniform(0.05, 0.8, 3) ** 2
    turned, _ = np.linalg.qr(random.normal(size=(3, 3)))
    inertia = turned @ np.diag(mass / 12.0 * (squares.sum() - squares)) @ turned.T
    return mass, com, (inertia + inertia.T) / 2.0


def golden(table, q, qd, qdd, tau, body):
    model, frame = build(table)
    mass, com, inertia = body
    tool = model.frames[frame]
    model.appendBodyToJoint(tool.parentJoint, pin.Inertia(mass, com, inertia), tool.placement)
    data = model.createData()
    friction = friction_torque(table, qd)
    return {
        "mass": [mass],
        "com": com,
        "inertia": inertia[XX_XY_XZ_YY_YZ_ZZ],
        "mass_matrix": pin.crba(model, data, q)[np.triu_indices(model.nv)],
        "inverse_dynamics": pin.rnea(model, data, q, qd, qdd) + friction,
        "gravity_torque": pin.computeGeneralizedGravity(model, data, q),
        "forward_dynamics": pin.aba(model, data, q, qd, tau - friction),
    }


def main():
    for path in sorted(ARMS.glob("*.toml")):
        table = tomllib.loads(path.read_text())
        if not table.get("payload", {}).get("runtime", False):
            continue
        random = np.random.default_rng(1985)
        states = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        with open(HERE / "data" / f"{path.stem}.payload.jsonl", "w") as out:
            for line in states:
                state = json.loads(line)
                arguments = [np.array(state[name]) for name in ("q", "qd", "qdd", "tau")]
                values = golden(table, *arguments, random_body(random))
                json.dump({name: list(map(float, value)) for name, value in values.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{path.stem}: {len(states)} payloads")


if __name__ == "__main__":
    main()
