"""What is derived from J, M and torques, whoever formulated them: by CasADi's derivatives and its solving of linear systems.

Each function returns a list of ways to the same expression; the caller keeps the one cheapest for CasADi.
"""

import functools
import operator

import casadi as ca


def solve(mass, right):
    pivots, lower, order = ca.ldl(mass)
    return ca.ldl_solve(right, pivots, lower, order)


def symmetric(matrix):
    return ca.tril2symm(ca.tril(matrix))


def derivatives(expression, variable):
    """The Jacobian: by coloring as CasADi does it, and by sweeps one by one, forward and reverse."""
    columns = (ca.DM(ca.Sparsity.unit(variable.numel(), k), 1) for k in range(variable.numel()))
    rows = (ca.DM(ca.Sparsity.unit(expression.numel(), k), 1) for k in range(expression.numel()))
    return [
        ca.jacobian(expression, variable),
        ca.horzcat(*(ca.jtimes(expression, variable, column) for column in columns)),
        ca.horzcat(*(ca.jtimes(expression, variable, row, True) for row in rows)).T,
    ]


def inverses(mass):
    """Of a symmetric, positive matrix: by its factors on the identity, and from the inverse of the triangular factor."""
    pivots, upper, _ = ca.ldl(mass, False)
    identity = ca.SX.eye(mass.shape[0])
    factor = ca.solve((upper + identity).T, identity)
    halves = symmetric(factor.T @ ca.diag(1 / pivots) @ factor)
    return [solve(mass, identity), halves, symmetric(ca.inv(mass))]


def rate(matrix, q, qd):
    """d/dt of a matrix."""
    return ca.reshape(ca.jtimes(ca.vec(ca.densify(matrix)), q, qd), *matrix.shape)


def coriolis_of_mass(mass, q, qd):
    """Christoffel's C = (dM/dt + A - A')/2, A = d(M q̇)/dq at constant q̇; and by his symbols."""
    symbols = twice_christoffel(mass, q)
    rows = [(qd.T @ symbols_of_one) / 2 for symbols_of_one in symbols]
    return [ca.vertcat(*rows)] + [(rate(mass, q, qd) + a - a.T) / 2 for a in derivatives(mass @ qd, q)]


def twice_christoffel(mass, q):
    """For each i the symmetric matrix of 2 Γ_ijk = ∂M_ij/∂q_k + ∂M_ik/∂q_j - ∂M_jk/∂q_i."""
    n = q.numel()
    by = ca.jacobian(ca.vec(mass), q)  # row j + n i is entry (i, j)
    slope = [[[by[j + n * i, k] for k in range(n)] for j in range(n)] for i in range(n)]
    found = []
    for i in range(n):
        symbols = ca.SX(n, n)
        for j in range(n):
            for k in range(j + 1):
                symbols[j, k] = slope[max(i, j)][min(i, j)][k] + slope[max(i, k)][min(i, k)][j] - slope[j][k][i]
        found.append(ca.tril2symm(symbols))
    return found


def coriolis_of_torques(torques, qd):
    """Christoffel's C is half the derivative by q̇ of the torques at q̈ = 0, which are quadratic in q̇ but for gravity."""
    return [d / 2 for d in derivatives(torques, qd)]


def forward_dynamics_derivatives(mass, bias, by_q, by_qd, x):
    """From those of the inverse dynamics, given as expressions in q̈ (= x.qdd): -M⁻¹ times them, at q̈ of the torques; and M⁻¹."""
    acceleration = solve(mass, x.qdd - bias)
    right = ca.substitute(ca.horzcat(by_q, by_qd), x.qdd, acceleration)
    identity = ca.SX.eye(mass.shape[0])
    solved = solve(mass, ca.horzcat(-right, identity))
    found = [solved]
    for inverse in inverses(mass):
        found.append(ca.horzcat(-inverse @ right, inverse))
    return found


def task_inertias(arm, jacobian, mass):
    """Over the task's rows: the inverse of J M⁻¹ J', M solved, or halved with the triangular factor."""
    rows = jacobian[arm.task, :]
    pivots, upper, _ = ca.ldl(mass, False)
    half = ca.solve((upper + ca.SX.eye(mass.shape[0])).T, rows.T)
    mobilities = [rows @ solve(mass, rows.T), symmetric(half.T @ ca.diag(1 / pivots) @ half)]
    return [inverse for mobility in mobilities for inverse in inverses(mobility)]


def spread(arm, matrix, by_rows):
    """Zeros where the task has no rows of its own."""
    n = matrix.shape[0]
    whole = ca.SX(6, 6) if by_rows else ca.SX(n, 6)
    for a, i in enumerate(arm.task):
        if by_rows:
            for b, j in enumerate(arm.task):
                whole[i, j] = matrix[a, b]
        else:
            whole[:, i] = matrix[:, a]
    return whole


def consistent_inverses(arm, jacobian, mass, inertia):
    rows = jacobian[arm.task, :]
    return [solve(mass, rows.T) @ inertia, solve(mass, rows.T @ inertia)]


def manipulability(arm, h, q):
    """√det(H'H) and its gradient by CasADi's reverse mode; H has a column for each of the task's rows.

    LDL' of H'H is the cheapest for CasADi (det, chol and solve cost more), but squares H's condition number, which a task
    with rows of v and of w together, in units of their own, cannot afford: it takes QR, for 5 % more operations.
    """
    if arm.task[0] < 3 <= arm.task[-1]:
        _, triangle = ca.qr(h)
        value = product(ca.diag(triangle))
    else:
        pivots, _, _ = ca.ldl(h.T @ h)
        value = ca.sqrt(product(pivots))
    return ca.vertcat(value, ca.gradient(value, q))


def product(factors):
    return functools.reduce(operator.mul, ca.vertsplit(factors))


def lock_impacts(torques, x):
    """Column k: torques before joint k locks, minus those after; friction, which the lock takes over, left out.

    `torques` is a function of q̇ and q̈, called N + 1 times.
    """
    before = torques(x.qd, x.qdd)
    columns = (before - torques(without(x.qd, k), without(x.qdd, k)) for k in range(x.q.numel()))
    return [ca.horzcat(*columns)]


def lock_impacts_of_mass(mass, x):
    """Expanded: M_k q̈_k, and of the torques that are quadratic in q̇ all products with q̇_k, by Christoffel's symbols."""
    n, symbols = x.q.numel(), twice_christoffel(mass, x.q)
    impacts = mass @ ca.diag(x.qdd)
    for k in range(n):
        for i in range(n):
            others = ca.dot(symbols[i][:, k], without(x.qd, k))
            impacts[i, k] += (others + symbols[i][k, k] / 2 * x.qd[k]) * x.qd[k]
    return [impacts]


def lock_impacts_expanded(velocity_torques, mass, x):
    """The same, M_k q̈_k + (dc/dq̇_k) q̇_k - (c of q̇_k alone): c(q̇) are the torques without gravity and friction at q̈ = 0,
    quadratic in q̇."""
    found = []
    for by_rate in derivatives(velocity_torques(x.qd), x.qd):
        columns = []
        for k in range(x.q.numel()):
            columns.append(mass[:, k] * x.qdd[k] + by_rate[:, k] * x.qd[k] - velocity_torques(alone(x.qd, k)))
        found.append(ca.horzcat(*columns))
    return found


def without(vector, k):
    return ca.vertcat(*(ca.SX(0) if i == k else vector[i] for i in range(vector.numel())))


def alone(vector, k):
    return ca.vertcat(*(vector[i] if i == k else ca.SX(0) for i in range(vector.numel())))
