"""w_D, its gradient, and M^-1 to 40 digits, at the configurations of golden_pinocchio.py.

Straight from Eq. 15 with numbers of 80 digits: H = J M^-1 over the task's rows, w_D the root of det(H H'),
its slopes by central differences with a step of 1e-25, whose error is of order 1e-50. The arm is built from its
table by a reading of its own and shares nothing with the Rust code or the other script.
Writes data/<arm>.manipulability.jsonl beside this file: one configuration a line, with
    w, gradient             w_D and its gradient
    inverse_mass_matrix     the upper triangle, row by row
    condition       the largest singular value of H over the smallest: how much of the rounding of M and J
                    a computation in doubles may have in w_D at best

    python3 -m venv .venv && .venv/bin/pip install mpmath==1.3.0
    .venv/bin/python tests/oracle/golden_mpmath.py [ARM...]
"""

import json
import pathlib
import sys
import tomllib

from mpmath import cos, det, diag, matrix, mp, mpf, nint, nstr, pi, sin, sqrt, svd_r

mp.dps = 80
STEP = mpf(10) ** -25
HERE = pathlib.Path(__file__).resolve().parent
ARMS = HERE.parent.parent / "arms"
ROWS = ["x", "y", "z", "rx", "ry", "rz"]


def radians(angle, unit):
    """A table in radians means the exact quarter turn where it has the double nearest to one."""
    if unit == "deg":
        return mpf(angle) * pi / 180
    quarters = nint(mpf(angle) * 2 / pi)
    return quarters * pi / 2 if float(quarters * pi / 2) == angle else mpf(angle)


def turn(axis, angle):
    c, s = cos(angle), sin(angle)
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    rotation = [[mpf(r == col) for col in range(3)] for r in range(3)]
    rotation[j][j] = rotation[k][k] = c
    rotation[j][k], rotation[k][j] = -s, s
    return rotation, [mpf(0)] * 3


def shift(*vector):
    return [[mpf(r == c) for c in range(3)] for r in range(3)], [mpf(x) for x in vector]


def rotate(rotation, vector):
    return [sum(row[k] * vector[k] for k in range(3)) for row in rotation]


def product(*poses):
    rotation, translation = shift(0, 0, 0)
    for turned, shifted in poses:
        translation = plus(rotate(rotation, shifted), translation)
        rotation = [[sum(row[k] * turned[k][c] for k in range(3)) for c in range(3)] for row in rotation]
    return rotation, translation


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Arm:
    def __init__(self, table):
        unit = table["angle_unit"]

        def placement(entry):
            roll, pitch, yaw = (radians(angle, unit) for angle in entry.get("rpy", [0.0, 0.0, 0.0]))
            return product(shift(*entry.get("xyz", [0.0, 0.0, 0.0])), turn("z", yaw), turn("y", pitch), turn("x", roll))

        self.base = placement(table.get("base", {}))
        self.tool = placement(table.get("tool", {}))
        self.modified = table["convention"] == "modified"
        self.rows = []
        # What the rotors behind their gears add to M's diagonal.
        motors = [row.get("motor", {}) for row in table["joint"]]
        self.rotors = [mpf(motor.get("inertia", 0.0)) * mpf(motor.get("ratio", 1.0)) ** 2 for motor in motors]
        for row in table["joint"]:
            link = row["link"]
            entries = {key: mpf(link["inertia"].get(key, 0.0)) for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
            inertia = [[entries["".join(sorted(a + b))] for b in "xyz"] for a in "xyz"]
            self.rows.append(
                (
                    row.get("kind", "revolute") == "revolute",
                    radians(row["theta"], unit),
                    mpf(row["d"]),
                    product(shift(row["a"], 0, 0), turn("x", radians(row["alpha"], unit))),
                    mpf(link["mass"]),
                    [mpf(x) for x in link["com"]],
                    inertia,
                )
            )
        task = table["task"]["rows"]
        task = {"position": ROWS[:3], "pose": ROWS}.get(task) if isinstance(task, str) else task
        self.task = [index for index, row in enumerate(ROWS) if row in task]

    def jacobian_and_mass_matrix(self, q):
        frame = self.base
        axes, links = [], []
        for (revolute, theta, d, across, mass, com, inertia), x in zip(self.rows, q):
            screw = product(turn("z", theta + (x if revolute else 0)), shift(0, 0, d + (0 if revolute else x)))
            before = product(frame, across) if self.modified else frame
            axes.append((revolute, [row[2] for row in before[0]], before[1]))
            frame = product(before, screw) if self.modified else product(before, screw, across)
            links.append((mass, plus(rotate(frame[0], com), frame[1]), frame[0], inertia))
        tool = product(frame, self.tool)[1]

        def velocity(axis, point):
            revolute, z, origin = axis
            return (cross(z, minus(point, origin)), z) if revolute else (z, [mpf(0)] * 3)

        columns = [sum(velocity(axis, tool), []) for axis in axes]
        n = len(q)
        mass_matrix = diag(self.rotors)
        for i, (mass, com, rotation, inertia) in enumerate(links):
            inward = [list(column) for column in zip(*rotation)]
            moves = [velocity(axis, com) for axis in axes[: i + 1]]
            spins = [rotate(inward, angular) for _, angular in moves]
            for r in range(i + 1):
                momentum = rotate(inertia, spins[r])
                for c in range(r + 1):
                    mass_matrix[r, c] += mass * dot(moves[r][0], moves[c][0]) + dot(momentum, spins[c])
                    mass_matrix[c, r] = mass_matrix[r, c]
        return matrix([[columns[c][r] for c in range(n)] for r in self.task]), mass_matrix

    def h(self, q):
        jacobian, mass_matrix = self.jacobian_and_mass_matrix(q)
        return jacobian * mass_matrix**-1

    def manipulability(self, q):
        h = self.h(q)
        return sqrt(det(h * h.T))


def golden(arm, q):
    gradient = []
    for i in range(len(q)):
        ahead, behind = list(q), list(q)
        ahead[i] += STEP
        behind[i] -= STEP
        gradient.append((arm.manipulability(ahead) - arm.manipulability(behind)) / (2 * STEP))
    with mp.workdps(30):
        singular = svd_r(arm.h(q), compute_uv=False)
        condition = max(singular) / min(singular)
    n = len(q)
    inverse = arm.jacobian_and_mass_matrix(q)[1] ** -1
    upper = [inverse[r, c] for r in range(n) for c in range(r, n)]
    return arm.manipulability(q), gradient, upper, condition


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        arm = Arm(tomllib.loads(path.read_text()))
        configurations = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        with open(HERE / "data" / f"{path.stem}.manipulability.jsonl", "w") as out:
            for line in configurations:
                q = [mpf(x) for x in json.loads(line)["q"]]
                w, gradient, inverse, condition = golden(arm, q)
                slopes, inverse = (",".join(nstr(x, 20) for x in row) for row in (gradient, inverse))
                line = f'"w":{nstr(w, 20)},"gradient":[{slopes}],"inverse_mass_matrix":[{inverse}]'
                out.write(f'{{{line},"condition":{nstr(condition, 3)}}}\n')
        print(f"{path.stem}: {len(configurations)} configurations")


if __name__ == "__main__":
    main()
