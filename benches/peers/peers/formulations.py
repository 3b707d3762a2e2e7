"""What CasADi is given: for each quantity an expression in q, qd and qdd (or tau), from one of several formulations.

A list of expressions are several ways to the same: `cheapest` keeps the one of the fewest operations.
"""

import itertools

import casadi as ca

from . import derived, textbook, textbook_bodies, textbook_spatial
from .arm import Arm, in_motion_alone
from .quantities import QUANTITIES

MATH = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a, _: -a,
    "sqrt": lambda a, _: ca.sqrt(a),
}

# What our formulation is itself: not a derivative of another, nor what comes of solving with M.
OURS = [
    "geometric_jacobian",
    "mass_matrix",
    "inverse_dynamics",
    "link_poses",
    "link_jacobians",
    "center_of_mass",
    "bias_acceleration",
    "kinetic_energy",
    "potential_energy",
    "regressor",
    "base_regressor",
]


class Arguments:
    def __init__(self, joints):
        self.q, self.qd, self.qdd = (ca.SX.sym(name, joints) for name in ("q", "qd", "qdd"))
        self.all = [self.q, self.qd, self.qdd]


def composites(arm: Arm, x: Arguments):
    """The textbook: composite rigid bodies in spatial algebra for M."""
    return from_textbook(arm, x, textbook.mass_matrix_of_composites(arm, x.q))


def newton_euler(arm: Arm, x: Arguments):
    """The textbook, by the cheapest way found: M as the derivative of the Newton-Euler torques by the accelerations."""
    still = ca.SX(len(arm.joints), 1)
    at_rest = textbook.inverse_dynamics(in_motion_alone(arm), x.q, still, x.qdd)
    return from_textbook(arm, x, derived.symmetric(ca.jacobian(at_rest, x.qdd)))


def from_textbook(arm, x, mass):
    still, jacobian, alone = ca.SX(len(arm.joints), 1), textbook.jacobian(arm, x.q), in_motion_alone(arm)
    bias = textbook.inverse_dynamics(arm, x.q, x.qd, still)
    torques = textbook.inverse_dynamics(arm, x.q, x.qd, x.qdd)

    def of_velocities(qd):
        return textbook.inverse_dynamics(alone, x.q, qd, still)

    by_q, by_qd = textbook_spatial.torque_derivatives(arm, x.q, x.qd, x.qdd)
    by_qd += ca.diag(ca.diag(ca.jacobian(textbook.friction(arm, x.qd), x.qd)))
    _, twice_coriolis = textbook_spatial.torque_derivatives(alone, x.q, x.qd, still)
    torque_derivatives = [ca.horzcat(by_q, by_qd), *pairs(torques, x.q, x.qd)]
    coriolis = [
        twice_coriolis / 2,
        *derived.coriolis_of_mass(mass, x.q, x.qd),
        *derived.coriolis_of_torques(of_velocities(x.qd), x.qd),
    ]
    impacts = [
        *derived.lock_impacts(lambda qd, qdd: textbook.inverse_dynamics(arm, x.q, qd, qdd) - textbook.friction(arm, qd), x),
        *derived.lock_impacts_expanded(of_velocities, mass, x),
        *derived.lock_impacts_of_mass(mass, x),
    ]
    return common(arm, x, jacobian, mass, bias, torque_derivatives) | {
        "inverse_dynamics": torques,
        "link_poses": textbook_bodies.link_poses(arm, x.q),
        "link_jacobians": textbook_bodies.link_jacobians(arm, x.q),
        "center_of_mass": textbook_bodies.centers_of_mass(arm, x.q),
        "jacobian_rate": [derived.rate(jacobian, x.q, x.qd), textbook_bodies.jacobian_rate(arm, x.q, x.qd)],
        "bias_acceleration": [
            textbook_bodies.bias_acceleration(arm, x.q, x.qd),
            ca.jtimes(jacobian @ x.qd, x.q, x.qd),
            textbook_bodies.jacobian_rate(arm, x.q, x.qd) @ x.qd,
        ],
        "coriolis_matrix": coriolis,
        "kinetic_energy": [textbook_bodies.kinetic_energy(arm, x.q, x.qd), x.qd.T @ mass @ x.qd / 2],
        "potential_energy": textbook_bodies.potential_energies(arm, x.q),
        "regressor": [
            textbook_bodies.regressor_by_axes(arm, x.q, x.qd, x.qdd),
            textbook_bodies.regressor_by_jacobian(arm, x.q, x.qd, x.qdd),
        ],
        "lock_impacts": impacts,
    }


def common(arm, x, jacobian, mass, bias, torque_derivatives):
    """What follows from J, M, the torques at q̈ = 0 and ways to the inverse dynamics' derivatives."""
    n = len(arm.joints)
    inertia = cheapest(x, derived.task_inertias(arm, jacobian, mass))
    by_torques = cheapest(x, torque_derivatives)
    return {
        "geometric_jacobian": jacobian,
        "mass_matrix": mass,
        "mass_matrix_derivatives": ca.jacobian(ca.vec(mass), x.q),
        "dynamic_manipulability_gradient": derived.manipulability(arm, derived.solve(mass, jacobian[arm.task, :].T), x.q),
        "forward_dynamics": derived.solve(mass, x.qdd - bias),
        "inverse_mass_matrix": derived.inverses(mass),
        "task_space_inertia": derived.spread(arm, inertia, by_rows=True),
        "dynamically_consistent_inverse": [
            derived.spread(arm, inverse, by_rows=False)
            for inverse in derived.consistent_inverses(arm, jacobian, mass, inertia)
        ],
        "manipulability_gradient": derived.manipulability(arm, jacobian[arm.task, :].T, x.q),
        "inverse_dynamics_derivatives": by_torques,
        "forward_dynamics_derivatives": derived.forward_dynamics_derivatives(
            mass, bias, by_torques[:, :n], by_torques[:, n:], x
        ),
    }


def ours(arm: Arm, x: Arguments, listing):
    """Our J, M, Newton-Euler recursion and the rest of OURS, node by node; what else there is, is CasADi's: all derivatives,
    w_D's by reverse sweeps, and all solving.

    w_D may take J in any frame in which it has the same value: all are tried, and the one cheapest for CasADi is kept.
    """
    n = len(arm.joints)
    methods = listing["methods"]
    built = {name: whole(methods[name], x, name) for name in [*OURS, "bias_force"] if name in methods}
    jacobian, mass = ca.reshape(built["geometric_jacobian"], 6, n), ca.reshape(built["mass_matrix"], n, n)
    whole_triplets = all(arm.task.count(3 * k) == arm.task.count(3 * k + 1) == arm.task.count(3 * k + 2) for k in (0, 1))
    gradients = []
    for program in listing["jacobians"]["world"] + (listing["jacobians"]["own"] if whole_triplets else []):
        in_frame = rebuild(program, x)
        rows, weights = ca.reshape(in_frame["jacobian"], 6, n)[arm.task, :], ca.reshape(in_frame["mass"], n, n)
        gradients.append(derived.manipulability(arm, derived.solve(weights, rows.T), x.q))

    def torques(qd, qdd):
        return whole(methods["inverse_dynamics"], Given(x.q, qd, qdd), "inverse_dynamics")

    def of_links(qd, qdd):
        return torques(qd, qdd) - textbook.friction(arm, qd)

    still = ca.SX(n, 1)
    bias = torques(x.qd, still) if arm.has_friction() else built["bias_force"]

    def of_velocities(qd):
        forces = [whole(methods["bias_force"], Given(x.q, rates, still), "bias_force") for rates in (qd, still)]
        return forces[0] - forces[1]

    coriolis, impacts = derived.coriolis_of_mass(mass, x.q, x.qd), derived.lock_impacts(of_links, x)
    if not arm.has_friction():  # which stands among the rest of the torques
        coriolis += derived.coriolis_of_torques(built["bias_force"], x.qd)
        impacts += derived.lock_impacts_expanded(of_velocities, mass, x)
        impacts += derived.lock_impacts_of_mass(mass, x)
    derivatives = pairs(built["inverse_dynamics"], x.q, x.qd)
    return common(arm, x, jacobian, mass, bias, derivatives) | built | {
        "dynamic_manipulability_gradient": gradients,
        "jacobian_rate": derived.rate(jacobian, x.q, x.qd),
        "coriolis_matrix": coriolis,
        "lock_impacts": impacts,
    }


def pairs(torques, q, qd):
    """Derivatives by q and by q̇, side by side, in every two ways."""
    ways = itertools.product(derived.derivatives(torques, q), derived.derivatives(torques, qd))
    return [ca.horzcat(*both) for both in ways]


def our_programs(arm: Arm, x: Arguments, listing):
    """Our programs to the last operation: what is left is the difference of compilers, sines and multiply-adds."""
    return {name: whole(listing["methods"][name], x, name) for name in QUANTITIES if name in listing["methods"]}


class Given:
    """Arguments that are expressions."""

    def __init__(self, q, qd, qdd):
        self.q, self.qd, self.qdd = q, qd, qdd


def whole(program, x, quantity):
    """All that a method returns, in a row: what its program has besides comes last, and is left out."""
    numbers = ca.vertcat(*rebuild(program, x).values())
    return numbers[: QUANTITIES[quantity].size(x.q.numel())] if quantity in QUANTITIES else numbers


def rebuild(program, x):
    """The outputs of one of our programs, as vectors in the order of their elements."""
    angles = [sum(x.q[i] for i in angle["joints"]) + angle["offset"] for angle in program["angles"]]
    steps = []
    read = {
        "number": ca.SX,
        "step": lambda i: steps[i],
        "q": lambda i: x.q[i],
        "sin": lambda i: ca.sin(angles[i]),
        "cos": lambda i: ca.cos(angles[i]),
        "qd": lambda i: x.qd[i],
        "qdd": lambda i: x.qdd[i],
        "tau": lambda i: x.qdd[i],  # the third argument, whatever it is called
        "wrench": lambda i: ca.SX(0),  # not an argument here
        "payload": lambda i: ca.SX(0),
    }
    for op, *operands in program["steps"]:
        steps.append(MATH[op](*(read[kind](what) for kind, what in operands)))
    return {o["name"]: ca.vertcat(*(read[kind](what) for kind, what in o["elements"])) for o in program["outputs"]}


def cheapest(x, ways):
    """Of expressions for the same, the one of the fewest operations."""
    if not isinstance(ways, list):
        return ways
    return min(ways, key=lambda way: operations(function("way", x, way))["total"]) if len(ways) > 1 else ways[0]


def function(name, x: Arguments, expression):
    """A function with one dense result, matrices by columns, common subexpressions shared."""
    return ca.Function(name, x.all, [ca.densify(ca.vec(expression))], {"cse": True})


# What an instruction of an SX function may be besides arithmetic.
SILENT = {ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST, ca.OP_PARAMETER, ca.OP_ASSIGN}
TRIGONOMETRY = {ca.OP_SIN, ca.OP_COS}


def operations(f):
    """Arithmetic operations, and sines and cosines, each counted once."""
    all_of_them = [f.instruction_id(k) for k in range(f.n_instructions())]
    arithmetic = [op for op in all_of_them if op not in SILENT]
    trigonometry = sum(op in TRIGONOMETRY for op in arithmetic)
    return {"total": len(arithmetic) - trigonometry, "sin_cos": trigonometry}
