"""Each problem, solved with the external arm and with CasADi's own expressions."""

import sys
import time
from dataclasses import dataclass

import casadi as ca
import numpy as np

from . import library, problem

# Joint by joint, rad, in so many seconds.
TASKS = {
    "planar_2r": problem.Task(np.zeros(2), np.array([1.0, -0.8]), 2.0, 20),
    "ssrms": problem.Task(np.zeros(7), 0.3 * np.array([1.0, -0.8, 0.6, -0.4, 0.5, -0.3, 0.2]), 20.0, 20),
}
# Transcription with a limited-memory Hessian is left out: of ssrms neither way ends within 1,000 iterations.
PAIRS = [("shooting", "limited-memory"), ("shooting", "exact"), ("transcription", "exact")]
HESSIANS = {"limited-memory": "limited memory", "exact": "of the Lagrangian"}
# Two optima are the same if they differ by no more, relatively.
SAME = 1e-6


@dataclass
class Solution:
    status: str
    iterations: int
    optimum: float
    build: float  # s of processors, from functions to a solver
    solve: float  # likewise


@dataclass
class Pair:
    formulation: str
    hessian: str
    external: Solution
    own: Solution

    @property
    def agrees(self):
        ends = [solution.optimum for solution in (self.external, self.own)]
        return abs(ends[0] - ends[1]) <= SAME * abs(ends[1])


@dataclass
class Arm:
    name: str
    task: problem.Task
    pairs: list
    difference: float  # of the functions and their Jacobians, relative to the largest entry
    generated: float  # what comes out of CasADi's C code for an expression with the external function is off by so much
    calls: dict  # (function, who) -> microseconds of a call, of its Jacobian


def arm(name: str) -> Arm:
    task = TASKS[name]
    path = library.library(name)
    ways = {"external": library.external(name, path), "own": library.own(name)}
    torques = np.array([np.array(ways["own"][0](*knot)).ravel() for knot in zip(*task.guess())])
    task.scale = np.maximum(abs(torques).max(axis=0), 0.05 * abs(torques).max())
    pairs = []
    for formulation, hessian in PAIRS:
        found = {who: solved(formulation, hessian, task, functions, torques) for who, functions in ways.items()}
        pairs.append(Pair(formulation, hessian, **found))
        print(name, pairs[-1], file=sys.stderr, flush=True)
    n = len(task.start)
    generated = through_generated_code(name, ways["external"], path)
    return Arm(name, task, pairs, difference(ways, n), generated, calls(ways, n))


def solved(formulation, hessian, task, functions, torques):
    inverse_dynamics, forward_dynamics = functions
    begin = time.process_time()
    if formulation == "shooting":
        nlp, first = problem.shooting(task, forward_dynamics, torques)
    else:
        nlp, first = problem.transcription(task, inverse_dynamics)
    # Limited-memory steps end where rounding ends them: a tolerance that they reach.
    ipopt = {"hessian_approximation": hessian, "print_level": 0, "sb": "yes", "max_iter": 1000, "tol": 1e-6, "max_wall_time": 90.0}
    solver = ca.nlpsol("solver", "ipopt", nlp, {"ipopt": ipopt, "print_time": False, "show_eval_warnings": False})
    built = time.process_time()
    result = solver(x0=first, lbg=0, ubg=0)
    stats = solver.stats()
    return Solution(stats["return_status"], stats["iter_count"], float(result["f"]), built - begin, time.process_time() - built)


def through_generated_code(name, functions, path):
    """The largest difference between the function and C code that CasADi writes of an expression with it, linked with the library."""
    n = len(TASKS[name].start)
    q, qd, tau = (ca.MX.sym(letter, n) for letter in ("q", "qd", "tau"))
    slope = ca.vertcat(qd, functions[1](q, qd, tau))
    model = ca.Function("model", [q, qd, tau], [slope, ca.jacobian(slope, q), ca.jacobian(slope, tau)])
    generator = ca.CodeGenerator("model.c")
    generator.add(model)
    source = path.with_name(f"model_{name}.c")
    source.write_text(generator.dump())
    compiled = source.with_suffix(".so")
    library.run(["cc", "-O2", "-shared", "-fPIC", source, path, f"-Wl,-rpath,{path.parent}", "-o", compiled, "-lm"])
    again, worst = ca.external("model", str(compiled)), 0.0
    for state in states(n):
        for a, b in zip(again(*state), model(*state)):
            worst = max(worst, float(ca.norm_inf(ca.vec(ca.densify(a - b)))))
    return worst


def states(n):
    return np.random.default_rng(1).uniform(-1, 1, (50, 3, n))


def difference(ways, n):
    worst = 0.0
    for external, own in zip(ways["external"], ways["own"]):
        nothing = ca.DM(n, 1)
        for state in states(n):
            pairs = [(external(*state), own(*state))]
            pairs += zip(external.jacobian()(*state, nothing), own.jacobian()(*state, nothing))
            for a, b in pairs:
                b = np.array(ca.densify(b))
                worst = max(worst, abs(np.array(ca.densify(a)) - b).max() / max(abs(b).max(), 1e-300))
    return worst


def calls(ways, n):
    """Microseconds of a call from within CasADi, many in one: its interpreter runs its own expressions, the external arm is compiled."""
    found, many = {}, 2000
    inputs = [ca.DM(np.random.default_rng(2).uniform(-1, 1, (n, many))) for _ in range(3)]
    for who, functions in ways.items():
        for function, name in zip(functions, ("inverse dynamics", "forward dynamics")):
            for kind, one in (("value", function), ("Jacobian", function.jacobian())):
                given = inputs if kind == "value" else [*inputs, ca.DM(n, many)]
                mapped, best = one.map(many), np.inf
                for _ in range(7):
                    begin = time.process_time()
                    mapped(*given)
                    best = min(best, time.process_time() - begin)
                found[name, kind, who] = 1e6 * best / many
    return found
