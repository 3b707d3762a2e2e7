"""What CasADi is given: for each quantity an expression in q, qd and qdd (or tau), from one of several formulations."""

import functools
import operator

import casadi as ca

from . import textbook
from .arm import Arm
from .quantities import QUANTITIES

MATH = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a, _: -a,
    "sqrt": lambda a, _: ca.sqrt(a),
}


class Arguments:
    def __init__(self, joints):
        self.q, self.qd, self.qdd = (ca.SX.sym(name, joints) for name in ("q", "qd", "qdd"))
        self.all = [self.q, self.qd, self.qdd]


def composites(arm: Arm, x: Arguments):
    """The textbook: composite rigid bodies in spatial algebra for M."""
    return from_textbook(arm, x, textbook.mass_matrix_of_composites(arm, x.q))


def newton_euler(arm: Arm, x: Arguments):
    """The textbook, by the cheapest way found: M as the derivative of the Newton-Euler torques by the accelerations."""
    at_rest = textbook.inverse_dynamics(arm, x.q, ca.SX(len(arm.joints), 1), x.qdd)
    return from_textbook(arm, x, symmetric(ca.jacobian(at_rest, x.qdd)))


def from_textbook(arm, x, mass):
    jacobian = textbook.jacobian(arm, x.q)
    bias = textbook.inverse_dynamics(arm, x.q, x.qd, ca.SX(len(arm.joints), 1))
    return {
        "geometric_jacobian": jacobian,
        "mass_matrix": mass,
        "mass_matrix_derivatives": ca.jacobian(ca.vec(mass), x.q),
        "dynamic_manipulability_gradient": manipulability(arm, jacobian, mass, x.q),
        "inverse_dynamics": textbook.inverse_dynamics(arm, x.q, x.qd, x.qdd),
        "forward_dynamics": solve(mass, x.qdd - bias),
    }


def ours(arm: Arm, x: Arguments, listing):
    """Our J, M and Newton-Euler recursion, node by node; everything else is CasADi's: dM, the gradient's reverse sweep, solving.

    w_D may take J in any frame in which it has the same value: all are tried, and the one cheapest for CasADi is kept.
    """
    n = len(arm.joints)
    (jacobian,), (mass,), (torque,), (bias,) = (
        rebuild(listing["methods"][name], x).values()
        for name in ("geometric_jacobian", "mass_matrix", "inverse_dynamics", "bias_force")
    )
    mass = ca.reshape(mass, n, n)
    whole_triplets = all(arm.task.count(3 * k) == arm.task.count(3 * k + 1) == arm.task.count(3 * k + 2) for k in (0, 1))
    candidates = []
    for program in listing["jacobians"]["world"] + (listing["jacobians"]["own"] if whole_triplets else []):
        built = rebuild(program, x)
        matrices = ca.reshape(built["jacobian"], 6, n), ca.reshape(built["mass"], n, n)
        candidates.append(manipulability(arm, *matrices, x.q))
    return {
        "geometric_jacobian": jacobian,
        "mass_matrix": mass,
        "mass_matrix_derivatives": ca.jacobian(ca.vec(mass), x.q),
        "dynamic_manipulability_gradient": min(candidates, key=lambda e: operations(function("w", x, e))["total"]),
        "inverse_dynamics": torque,
        "forward_dynamics": solve(mass, x.qdd - bias),
    }


def our_programs(arm: Arm, x: Arguments, listing):
    """Our programs to the last operation: what is left is the difference of compilers, sines and multiply-adds."""
    outputs = {name: rebuild(listing["methods"][name], x) for name in QUANTITIES}
    w = outputs["dynamic_manipulability_gradient"]
    outputs["dynamic_manipulability_gradient"] = {"both": ca.vertcat(w["value"], w["gradient"])}
    return {name: next(iter(built.values())) for name, built in outputs.items()}


def manipulability(arm: Arm, jacobian, mass, q):
    """w_D over the arm's task, and its gradient by CasADi's reverse mode.

    LDL' of HH' is the cheapest for CasADi (det, chol and solve cost more), but squares H's condition number, which a task
    with rows of v and of w together, in units of their own, cannot afford: it takes QR, for 5 % more operations.
    """
    h = solve(mass, jacobian[arm.task, :].T)
    if arm.task[0] < 3 <= arm.task[-1]:
        _, triangle = ca.qr(h)
        value = product(ca.diag(triangle))
    else:
        pivots, _, _ = ca.ldl(h.T @ h)
        value = ca.sqrt(product(pivots))
    return ca.vertcat(value, ca.gradient(value, q))


def product(factors):
    return functools.reduce(operator.mul, ca.vertsplit(factors))


def solve(mass, right):
    pivots, lower, order = ca.ldl(mass)
    return ca.ldl_solve(right, pivots, lower, order)


def symmetric(matrix):
    return ca.tril2symm(ca.tril(matrix))


def rebuild(program, x: Arguments):
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
    }
    for op, *operands in program["steps"]:
        steps.append(MATH[op](*(read[kind](what) for kind, what in operands)))
    return {o["name"]: ca.vertcat(*(read[kind](what) for kind, what in o["elements"])) for o in program["outputs"]}


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
