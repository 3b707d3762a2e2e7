"""An arm's w_D and gradient in rigorous balls of as many digits as it takes. golden_light.py and judge_random_arms.py use it.

Straight from Eq. 15, H = J M^-1 over the task's rows and w_D the root of det(H H'), on Arb's balls (python-flint): every
number carries a bound of its rounding, and where a result is not known to DIGITS digits the precision is doubled.
The slopes are central differences; the step is so small that truncation, which the balls do not hold, is of order 1e-120.

The arm is built from its table by a reading of its own. Numbers are the doubles that the table's decimals stand for, and
angles those that the program turns degrees into (src/model/validate.rs, src/model/angle.rs): x * (pi / 180) in doubles, but
exact where that is a whole quarter turn to within its last bits. Everything after it is exact.
"""

import math

import numpy
from flint import arb, arb_mat, ctx

ROWS = ["x", "y", "z", "rx", "ry", "rz"]
HALF_PI = math.pi / 2
DIGITS = 60
BITS = [512, 1024, 2048, 4096]


def angle(value, unit):
    """A table's angle as whole quarter turns and radians."""
    if unit == "deg":
        quarters = round_half_away(value / 90.0)
        radians = quarters * HALF_PI if value == quarters * 90.0 else value * (math.pi / 180.0)
    else:
        radians = value
    quarters = round_half_away(radians / HALF_PI)
    rest = radians - quarters * HALF_PI
    if abs(rest) <= 4.0 * 2.0**-52 * abs(radians):
        return int(quarters), 0.0
    return 0, radians


def round_half_away(x):
    return math.trunc(x + math.copysign(0.5, x))


def sine_and_cosine(quarters, radians):
    s, c = radians.sin_cos() if isinstance(radians, arb) else arb(radians).sin_cos()
    for _ in range(quarters % 4):
        s, c = c, -s
    return s, c


def turn(axis, sine, cosine):
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    rotation = [[arb(r == col) for col in range(3)] for r in range(3)]
    rotation[j][j] = rotation[k][k] = cosine
    rotation[j][k], rotation[k][j] = -sine, sine
    return rotation


def rotate(rotation, vector):
    x, y, z = vector
    return [row[0] * x + row[1] * y + row[2] * z for row in rotation]


def multiply(a, b):
    columns = [rotate(a, column) for column in zip(*b)]
    return [list(row) for row in zip(*columns)]


def plus(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


class Arm:
    """An arm as its table has it: doubles, and angles as `angle` reads them."""

    def __init__(self, table):
        unit = table["angle_unit"]

        def placement(entry):
            return entry.get("xyz", [0.0] * 3), [angle(x, unit) for x in entry.get("rpy", [0.0] * 3)]

        self.base = placement(table.get("base", {}))
        self.tool = placement(table.get("tool", {}))
        self.modified = table["convention"] == "modified"
        self.joints = [
            {
                "revolute": row.get("kind", "revolute") == "revolute",
                "theta": angle(row["theta"], unit),
                "alpha": angle(row["alpha"], unit),
                "a": float(row["a"]),
                "d": float(row["d"]),
                "mass": float(row["link"]["mass"]),
                "com": row["link"]["com"],
                "motor": [float(row.get("motor", {}).get(*part)) for part in (("inertia", 0.0), ("ratio", 1.0))],
                "inertia": [
                    [row["link"]["inertia"].get("".join(sorted(a + b)), 0.0) for b in "xyz"] for a in "xyz"
                ],
            }
            for row in table["joint"]
        ]
        task = table["task"]["rows"]
        task = {"position": ROWS[:3], "pose": ROWS}.get(task) if isinstance(task, str) else task
        self.task = [index for index, row in enumerate(ROWS) if row in task]

    def placed(self, frame, placement):
        rotation, origin = frame
        xyz, (roll, pitch, yaw) = placement
        origin = plus(origin, rotate(rotation, [arb(x) for x in xyz]))
        for axis, turned in (("z", yaw), ("y", pitch), ("x", roll)):
            rotation = multiply(rotation, turn(axis, *sine_and_cosine(*turned)))
        return rotation, origin

    def jacobian_and_mass_matrix(self, q):
        """J over the task's rows, and M, at the balls `q`."""
        zero = arb(0)
        frame = self.placed((turn("x", zero, arb(1)), [zero] * 3), self.base)
        axes, links = [], []
        for joint, x in zip(self.joints, q):
            quarters, theta = joint["theta"]
            across = turn("x", *sine_and_cosine(*joint["alpha"]))
            offset = [arb(joint["a"]), zero, zero]
            revolute = joint["revolute"]
            screw = turn("z", *sine_and_cosine(quarters, theta + x if revolute else arb(theta)))
            along = [zero, zero, joint["d"] + (zero if revolute else x)]
            rotation, origin = frame
            if self.modified:
                origin = plus(origin, rotate(rotation, offset))
                rotation = multiply(rotation, across)
            axes.append((revolute, [row[2] for row in rotation], origin))
            origin = plus(origin, rotate(rotation, along))
            rotation = multiply(rotation, screw)
            if not self.modified:
                origin = plus(origin, rotate(rotation, offset))
                rotation = multiply(rotation, across)
            frame = rotation, origin
            com = plus(origin, rotate(rotation, [arb(x) for x in joint["com"]]))
            links.append((joint, com, rotation))
        tool = self.placed(frame, self.tool)[1]

        def velocity(axis, point):
            revolute, z, origin = axis
            return (cross(z, minus(point, origin)), z) if revolute else (z, [zero] * 3)

        n = len(q)
        columns = [sum(velocity(axis, tool), []) for axis in axes]
        mass_matrix = [[zero] * n for _ in range(n)]
        for i, (joint, com, rotation) in enumerate(links):
            rotor, ratio = (arb(x) for x in joint["motor"])
            mass_matrix[i][i] += rotor * ratio * ratio
            inward = [list(column) for column in zip(*rotation)]
            moves = [velocity(axis, com) for axis in axes[: i + 1]]
            spins = [rotate(inward, angular) for _, angular in moves]
            inertia = [[arb(x) for x in row] for row in joint["inertia"]]
            mass = arb(joint["mass"])
            for r in range(i + 1):
                momentum = rotate(inertia, spins[r])
                linear = [mass * x for x in moves[r][0]]
                for c in range(r + 1):
                    mass_matrix[r][c] += dot(linear, moves[c][0]) + dot(momentum, spins[c])
                    mass_matrix[c][r] = mass_matrix[r][c]
        jacobian = [[columns[c][r] for c in range(n)] for r in self.task]
        return arb_mat(jacobian), arb_mat(mass_matrix)

    def gram(self, q):
        """det(H H'), a ball."""
        jacobian, mass_matrix = self.jacobian_and_mass_matrix(q)
        h_transposed = mass_matrix.solve(jacobian.transpose())
        return (h_transposed.transpose() * h_transposed).det()

    def manipulability(self, q):
        """w_D and its gradient at the doubles `q`, each good to DIGITS digits of the largest of them.

        None for both where w_D is 0 to half the bits of the highest precision: there it has a kink.
        """
        for bits in BITS:
            ctx.prec = bits
            try:
                w, gradient = self.differences(q, bits)
            except (ValueError, ZeroDivisionError):  # a ball with 0 in it, under a root or in M
                continue
            numbers = [w, *gradient]
            scale = max(abs(float(x.mid())) for x in numbers)
            if all(x.is_finite() for x in numbers) and all(
                float(x.rad()) <= 10.0**-DIGITS * scale for x in numbers
            ):
                return w, gradient
        return None, None

    def differences(self, q, bits):
        step = arb(2) ** (-2 * bits // 5)  # below 1e-60
        centre = [arb(x) for x in q]
        w_squared = self.gram(centre)
        if not w_squared > 0:
            raise ValueError
        w = w_squared.sqrt()
        gradient = []
        for i in range(len(q)):
            ahead, behind = list(centre), list(centre)
            ahead[i] += step
            behind[i] -= step
            # The slope of w_D from that of its square, which is smooth where w_D has a kink.
            slope = (self.gram(ahead) - self.gram(behind)) / (2 * step)
            gradient.append(slope / (2 * w))
        return w, gradient

    def condition(self, q):
        """Of J over the task's rows, those of v divided by the chain's length and prismatic columns multiplied by it.

        The largest singular value counts as 1 at least, the size of an axis: a single row is singular where it is all but 0.
        In doubles: beyond 1e15 the number only says "very"."""
        ctx.prec = BITS[0]
        jacobian, _ = self.jacobian_and_mass_matrix([arb(x) for x in q])
        length = self.length(q)
        scaled = [
            [
                jacobian[r, c]
                / (length if row < 3 else 1)
                * (1 if self.joints[c]["revolute"] else length)
                for c in range(len(q))
            ]
            for r, row in enumerate(self.task)
        ]
        values = numpy.array([[float(x.mid()) for x in row] for row in scaled])
        singular = numpy.linalg.svd(values, compute_uv=False)
        return float(max(singular[0], 1.0) / singular[-1]) if singular[-1] > 0 else math.inf

    def length(self, q):
        links = sum(
            math.hypot(joint["a"], joint["d"] + (0.0 if joint["revolute"] else x)) for joint, x in zip(self.joints, q)
        )
        return links + math.hypot(*self.tool[0]) or 1.0
