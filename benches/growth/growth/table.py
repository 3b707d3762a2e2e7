"""A seeded generator of arm tables: as many joints as are asked for, and none of an arm's luck.

Twists are oblique, inertias are full, every sixth joint slides. The first joints of a longer arm are those of a
shorter one, so that what grows from one size to the next is the number of joints alone.
"""

import random

import numpy as np

ROWS = ["x", "y", "z"]
EVERY_SLIDING_JOINT = 6


def table(joints: int, seed: int) -> str:
    """The table of an arm, as TOML."""
    draw = random.Random(seed).uniform
    rows = ", ".join(f'"{row}"' for row in ROWS[:joints])
    head = f"""\
name = "{name(joints)}"
convention = "modified"
angle_unit = "deg"
gravity = [0.0, 0.0, -9.81]

[task]
rows = [{rows}]

[tool]
xyz = {vector(draw(-0.1, 0.1) for _ in range(3))}
rpy = {vector(draw(-90, 90) for _ in range(3))}
"""
    return head + "".join(joint(i, draw) for i in range(1, joints + 1))


def name(joints: int) -> str:
    return f"growth_{joints}"


def joint(number: int, draw) -> str:
    kind = "revolute" if number % EVERY_SLIDING_JOINT else "prismatic"
    mass = draw(1, 10)
    xx, yy, zz, xy, xz, yz = inertia(mass, draw)
    return f"""
[[joint]]
kind = "{kind}"
theta = {draw(-180, 180):.2f}
d = {draw(0.05, 0.3):.3f}
a = {draw(0.05, 0.5):.3f}
alpha = {sign(draw) * draw(10, 80):.2f}
[joint.link]
mass = {mass:.3f}
com = {vector(draw(-0.2, 0.2) for _ in range(3))}
inertia = {{ xx = {xx:.7f}, yy = {yy:.7f}, zz = {zz:.7f}, xy = {xy:.7f}, xz = {xz:.7f}, yz = {yz:.7f} }}
"""


def inertia(mass: float, draw) -> list[float]:
    """xx, yy, zz, xy, xz, yz of a uniform box, turned: such a body exists."""
    squares = np.array([draw(0.1, 0.5) ** 2 for _ in range(3)])
    rotation = np.linalg.qr([[draw(-1, 1) for _ in range(3)] for _ in range(3)])[0]
    tensor = rotation @ np.diag(mass / 12 * (squares.sum() - squares)) @ rotation.T
    return [tensor[place] for place in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]


def vector(components) -> str:
    return "[" + ", ".join(f"{x:.3f}" for x in components) + "]"


def sign(draw) -> int:
    return 1 if draw(-1, 1) > 0 else -1
