"""Two ways to ask for the same motion: from rest to rest, least torque. Dynamics come in as functions, whoever made them."""

from dataclasses import dataclass

import casadi as ca
import numpy as np

# How much being off the straight way counts beside the torques: without it, arms with light wrists have many minima that hardly differ.
TRACKING = 1.0


@dataclass
class Task:
    """From rest at `start` to rest at `goal`, rad, in so many seconds and intervals."""

    start: np.ndarray
    goal: np.ndarray
    seconds: float
    intervals: int
    scale: np.ndarray = None  # of the torques at each joint: the cost is of what they are in these units

    def guess(self):
        """Straight in joint space, with a smooth start and stop: positions, rates and accelerations at every knot, a knot a row."""
        s = np.linspace(0, 1, self.intervals + 1)[:, None]
        way = (self.goal - self.start)[None, :]
        position = self.start + way * (10 * s**3 - 15 * s**4 + 6 * s**5)
        rate = way * (30 * s**2 - 60 * s**3 + 30 * s**4) / self.seconds
        acceleration = way * (60 * s - 180 * s**2 + 120 * s**3) / self.seconds**2
        return position, rate, acceleration


def shooting(task: Task, forward_dynamics, torques):
    """Multiple shooting with the forward dynamics, a step of Runge and Kutta's fourth order an interval, torques constant on each.

    `torques`, a knot a row, are those of the guess. Returns the nonlinear program, whose constraints are 0, and where to start.
    """
    n, h = len(task.start), task.seconds / task.intervals
    position, rate, _ = task.guess()

    def slope(state, torque):
        return ca.vertcat(state[n:], forward_dynamics(state[:n], state[n:], task.scale * torque))

    def step(state, torque):
        k1 = slope(state, torque)
        k2 = slope(state + h / 2 * k1, torque)
        k3 = slope(state + h / 2 * k2, torque)
        k4 = slope(state + h * k3, torque)
        return state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    at = [ca.MX.sym(f"x{k}", 2 * n) for k in range(task.intervals + 1)]
    by = [ca.MX.sym(f"u{k}", n) for k in range(task.intervals)]
    rest = np.zeros(n)
    constraints = [at[0] - ca.vertcat(task.start, rest), at[-1] - ca.vertcat(task.goal, rest)]
    constraints += [step(at[k], by[k]) - at[k + 1] for k in range(task.intervals)]
    cost = h * sum(ca.sumsqr(torque) for torque in by)
    cost += TRACKING * h * sum(ca.sumsqr(at[k][:n] - position[k]) for k in range(task.intervals + 1))
    first = np.concatenate([np.hstack([position, rate]).ravel(), (torques[:-1] / task.scale).ravel()])
    return {"x": ca.vertcat(*at, *by), "f": cost, "g": ca.vertcat(*constraints)}, first


def transcription(task: Task, inverse_dynamics):
    """Direct transcription with the inverse dynamics: positions, rates and accelerations at the knots, trapezoids between them."""
    n, h = len(task.start), task.seconds / task.intervals
    position, rate, acceleration = task.guess()
    q, qd, qdd = ([ca.MX.sym(f"{name}{k}", n) for k in range(task.intervals + 1)] for name in ("q", "qd", "qdd"))
    constraints = [q[0] - task.start, qd[0], q[-1] - task.goal, qd[-1]]
    for k in range(task.intervals):
        constraints += [q[k + 1] - q[k] - h / 2 * (qd[k] + qd[k + 1]), qd[k + 1] - qd[k] - h / 2 * (qdd[k] + qdd[k + 1])]
    weights = [h / 2, *[h] * (task.intervals - 1), h / 2]
    cost = sum(weight * ca.sumsqr(inverse_dynamics(*knot) / task.scale) for weight, *knot in zip(weights, q, qd, qdd))
    cost += TRACKING * h * sum(ca.sumsqr(q[k] - position[k]) for k in range(task.intervals + 1))
    first = np.concatenate([position.ravel(), rate.ravel(), acceleration.ravel()])
    return {"x": ca.vertcat(*q, *qd, *qdd), "f": cost, "g": ca.vertcat(*constraints)}, first
