"""w_D and its gradient to 20 digits for arms that are hard on a computation in doubles: data/light/.

Arms whose last link has next to no inertia, two axes a thousandth of a degree from parallel, and planar_2r all but
stretched out. Every arm but planar_2r is written here too, as data/light/<arm>.toml; data/light/<arm>.jsonl has one
configuration a line, with
    q               joint coordinates; they read back as the same doubles
    w, gradient     w_D and its gradient
    condition       of J over the task's rows, dimensionless
exact_arm.py says how, and what a table's numbers are taken for.

    python3 -m venv .venv && .venv/bin/pip install python-flint==0.9.0 numpy==2.4.6
    .venv/bin/python tests/oracle/golden_light.py
"""

import json
import math
import pathlib
import random
import tomllib

from exact_arm import Arm

CONFIGURATIONS = 20
HERE = pathlib.Path(__file__).resolve().parent
LIGHT = HERE / "data" / "light"


def joint(theta, d, a, alpha, mass, com, inertia, kind="revolute"):
    entries = ", ".join(f"{key} = {value}" for key, value in zip(("xx", "yy", "zz", "xy", "xz", "yz"), inertia))
    return f"""
[[joint]]
kind = "{kind}"
theta = {float(theta)}
d = {float(d)}
a = {float(a)}
alpha = {float(alpha)}
[joint.link]
mass = {float(mass)}
com = {[float(x) for x in com]}
inertia = {{ {entries} }}
"""


def table(name, rows, tool, joints):
    return f"""name = "{name}"
convention = "modified"
angle_unit = "deg"

[task]
rows = {json.dumps(rows)}

[tool]
xyz = {tool}
{"".join(joints)}"""


def two(name, last):
    """An arm of two square axes."""
    ball = [last] * 3
    joints = [
        joint(0, 0.2, 0, 0, 2, [0.3, 0, 0], [0.1, 0.2, 0.2]),
        joint(0, 0, 0.5, 90, 0.3, [0, 0, 0], ball),
    ]
    return table(name, ["x", "z"], [0.1, 0.2, 0.3], joints)


def six(name, rows, last):
    """An arm built like a PUMA, by a workshop that keeps no right angle."""
    joints = [
        joint(0, 0.4, 0, 0, 13, [0.01, 0.02, -0.15], [0.35, 0.34, 0.09]),
        joint(12, 0.15, 0.02, -88.7, 17.4, [0.2, -0.01, 0.06], [0.13, 0.52, 0.54, 0.01, -0.02, 0.005]),
        joint(-7.5, -0.09, 0.43, 1.4, 4.8, [0.02, -0.06, 0.01], [0.0765, 0.0125, 0.086]),
        joint(0, 0.43, -0.02, 91.3, 0.82, [0.005, 0, -0.02], [0.0018, 0.0018, 0.0013]),
        joint(3, 0.012, 0.007, -89.2, 0.34, [0, 0.003, 0.002], [3e-4, 3e-4, 4e-4]),
        joint(0, 0.03, -0.004, 90.8, 0.09, [0, 0, 0], [last] * 3),
    ]
    return table(name, rows, [0.02, -0.01, 0.12], joints)


def mixed(name, last):
    """A sliding joint between turning ones, a task of unlike rows, a last link that is no ball."""
    joints = [
        joint(20, 0.3, 0, 0, 8, [0.05, 0, -0.1], [0.2, 0.21, 0.05]),
        joint(-35, 0.25, 0.1, 70, 3.5, [0, 0.02, -0.2], [0.09, 0.1, 0.02], "prismatic"),
        joint(0, 0.05, 0.3, -40, 1.2, [0.08, 0, 0.01], [0.002, 0.009, 0.01]),
        joint(15, 0.02, 0.04, 65, 0.2, [0, 0, 0], [last, float(f"{1.5 * last:.2g}"), 0.8 * last]),
    ]
    return table(name, ["x", "z", "ry"], [0.03, 0.01, 0.08], joints)


def parallel(name, rows):
    """Two axes a thousandth of a degree from parallel."""
    joints = [
        joint(0, 0.1, 0, 0, 2, [0.2, 0, 0], [0.01, 0.06, 0.06]),
        joint(10, 0.05, 0.4, 0.001, 1, [0.15, 0, 0], [0.005, 0.03, 0.03]),
    ]
    return table(name, rows, [0.3, 0, 0], joints)


def tables():
    power = {1e-4: "1e_4", 1e-6: "1e_6", 1e-8: "1e_8", 1e-10: "1e_10"}
    for last, text in power.items():
        yield f"two_{text}", two(f"two_{text}", last)
    for last in (1e-6, 1e-8, 1e-10):
        for rows in ("position", "pose"):
            name = f"six_{rows}_{power[last]}"
            yield name, six(name, rows, last)
    for last in (1e-6, 1e-8):
        yield f"mixed_{power[last]}", mixed(f"mixed_{power[last]}", last)
    yield "parallel_turns", parallel("parallel_turns", ["rx", "rz"])
    yield "parallel_reach", parallel("parallel_reach", ["x", "z"])


def write(name, arm, configurations):
    with open(LIGHT / f"{name}.jsonl", "w") as out:
        for q in configurations:
            w, gradient = arm.manipulability(q)
            assert w is not None, f"{name}: w_D is 0 at {q}"
            slopes = ",".join(digits(slope) for slope in gradient)
            condition = arm.condition(q)
            out.write(f'{{"q":{json.dumps(q)},"w":{digits(w)},"gradient":[{slopes}],"condition":{condition:.2e}}}\n')
    print(f"{name}: {len(configurations)} configurations")


def digits(ball):
    """20 digits; 0 where the ball is 0 to the digits that were asked for."""
    return "0.0" if ball.contains(0) else ball.str(20, radius=False)


def main():
    LIGHT.mkdir(parents=True, exist_ok=True)
    for name, text in tables():
        (LIGHT / f"{name}.toml").write_text(text)
        arm = Arm(tomllib.loads(text))
        source = random.Random(name)
        ranges = [math.pi if joint["revolute"] else 1.0 for joint in arm.joints]
        write(name, arm, [[source.uniform(-x, x) for x in ranges] for _ in range(CONFIGURATIONS)])
    stretched = Arm(tomllib.loads((HERE.parent.parent / "arms" / "planar_2r.toml").read_text()))
    write("planar_2r", stretched, [[0.3, elbow] for elbow in (1e-3, 1e-6, 1e-9, 1e-10)])


if __name__ == "__main__":
    main()
