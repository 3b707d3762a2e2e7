"""Every method against numbers that were made outside: by Pinocchio, and by mpmath to 40 digits (``tests/oracle``)."""

import json
from functools import cache

import numpy as np
import pytest

from conftest import ROOT, load

DATA = ROOT / "tests" / "oracle" / "data"
ARMS = ["ssrms", "geared_6", "oblique_6"]
TOLERANCE = 1e-12
#: Of what J's rows are made orthogonal for.
OF_TASK = 1e-11


@cache
def lines(file):
    text = (DATA / file).read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def column(file, key):
    return np.array([line[key] for line in lines(file)])


@pytest.fixture(params=ARMS)
def arm(request):
    return load(request.param)


@pytest.fixture
def states(arm):
    return tuple(column(f"{arm.name}.jsonl", key) for key in ("q", "qd", "qdd", "tau"))


def near(actual, expected, tolerance=TOLERANCE, condition=1.0):
    """Relative to the largest entry of each state."""
    expected = np.asarray(expected).reshape(len(actual), -1)
    difference = np.abs(np.asarray(actual).reshape(len(actual), -1) - expected).max(axis=1)
    scale = np.abs(expected).max(axis=1)
    error = difference / (np.where(scale == 0.0, 1.0, scale) * condition)
    assert error.max() < tolerance


def upper(matrices):
    return matrices[(..., *np.triu_indices(matrices.shape[-1]))]


def test_dynamics(arm, states):
    q, qd, qdd, tau = states
    golden = lambda key: column(f"{arm.name}.jsonl", key)  # noqa: E731
    near(arm.forward_kinematics(q)[:, :3], golden("pose"))
    near(arm.geometric_jacobian(q), golden("jacobian"))
    near(np.einsum("sirc,si->src", arm.jacobian_derivatives(q), qd), golden("jacobian_rate"))
    near(arm.jacobian_rate(q, qd), golden("jacobian_rate"))
    near(upper(arm.mass_matrix(q)), golden("mass_matrix"))
    near(upper(np.einsum("sirc,si->src", arm.mass_matrix_derivatives(q), qd)), golden("mass_matrix_rate"))
    near(arm.inverse_dynamics(q, qd, qdd), golden("inverse_dynamics"))
    near(arm.bias_force(q, qd), golden("bias_force"))
    near(arm.gravity_torque(q), golden("gravity_torque"))
    near(arm.forward_dynamics(q, qd, tau), golden("forward_dynamics"))
    if "friction_torque" in lines(f"{arm.name}.jsonl")[0]:
        near(arm.friction_torque(qd), golden("friction_torque"))
    else:
        assert not arm.friction_torque(qd).any()


def test_motion(arm, states):
    q, qd, *_ = states
    golden = lambda key: column(f"{arm.name}.motion.jsonl", key)  # noqa: E731
    expected = golden("link_poses").reshape(len(q), arm.n, 7)
    poses = arm.link_poses(q)
    near(poses[..., :3, 3], expected[..., :3])
    near(poses[..., :3, :3], rotations(expected[..., 3:]))
    assert (poses[..., 3, :] == [0.0, 0.0, 0.0, 1.0]).all()
    near(np.einsum("slrc,sc->slr", arm.link_jacobians(q), qd), golden("link_velocities"))
    near(arm.center_of_mass(q), golden("center_of_mass"))
    near(arm.bias_acceleration(q, qd), golden("bias_acceleration"))
    near(arm.coriolis_matrix(q, qd), golden("coriolis_matrix"))
    near(arm.kinetic_energy(q, qd), golden("kinetic_energy"))
    near(arm.potential_energy(q), golden("potential_energy"))


def rotations(quaternions):
    x, y, z, w = np.moveaxis(quaternions, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), [0, 1], [-2, -1])


def test_task(arm, states):
    q = states[0]
    golden = lambda key: column(f"{arm.name}.motion.jsonl", key)  # noqa: E731
    rows = [["x", "y", "z", "rx", "ry", "rz"].index(row) for row in arm.task]
    inertia, inverse = arm.task_space_inertia(q), arm.dynamically_consistent_inverse(q)
    near(upper(inertia[:, rows][:, :, rows]), golden("task_space_inertia"), OF_TASK)
    near(inverse[:, :, rows], golden("consistent_inverse"), OF_TASK)
    w, gradient = arm.manipulability_gradient(q)
    near(w, golden("w"), OF_TASK)
    near(gradient, golden("gradient"), OF_TASK)
    outside = [row for row in range(6) if row not in rows]
    assert not inertia[:, outside].any() and not inverse[:, :, outside].any()


def test_dynamic_manipulability(arm, states):
    q = states[0]
    golden = lambda key: column(f"{arm.name}.manipulability.jsonl", key)  # noqa: E731
    near(arm.dynamic_manipulability(q), golden("w"), OF_TASK)
    w, gradient = arm.dynamic_manipulability_gradient(q)
    near(w, golden("w"), OF_TASK)
    near(gradient, golden("gradient"), OF_TASK)
    near(upper(arm.inverse_mass_matrix(q)), golden("inverse_mass_matrix"), OF_TASK)
    jacobian, w_again, gradient_again = arm.jacobian_and_gradient(q)
    near(jacobian, arm.geometric_jacobian(q))
    near(w_again, w, OF_TASK)
    near(gradient_again, gradient, OF_TASK)


def test_derivatives(arm, states):
    q, qd, qdd, tau = states
    golden = lambda key: column(f"{arm.name}.derivatives.jsonl", key)  # noqa: E731
    by_q, by_qd = arm.inverse_dynamics_derivatives(q, qd, qdd)
    near(by_q, golden("inverse_dynamics_by_q"))
    near(by_qd, golden("inverse_dynamics_by_qd"))
    by_q, by_qd, by_tau = arm.forward_dynamics_derivatives(q, qd, tau)
    condition = np.linalg.cond(arm.mass_matrix(q))
    near(by_q, golden("forward_dynamics_by_q"), 1e-15, condition)
    near(by_qd, golden("forward_dynamics_by_qd"), 1e-15, condition)
    near(upper(by_tau), golden("forward_dynamics_by_tau"), 1e-15, condition)
    masses, derivatives = arm.mass_matrix_and_derivatives(q)
    near(masses, arm.mass_matrix(q))
    near(derivatives, arm.mass_matrix_derivatives(q))


def test_locks(arm, states):
    q, qd, qdd, _ = states
    impacts = arm.lock_impacts(q, qd, qdd)
    # Column by column.
    near(impacts.swapaxes(1, 2), column(f"{arm.name}.lock.jsonl", "lock_impacts"))


def test_regressor(arm, states):
    q, qd, qdd, _ = states
    golden = lines(f"{arm.name}.regressor.jsonl")
    weights = np.array([line["weights"] for line in golden])
    weighted = np.array([line["weighted"] for line in golden])
    blocks = arm.regressor(q, qd, qdd)
    near(np.einsum("slrp,sp->slr", blocks, weights), weighted)
    base = arm.base_regressor(q, qd, qdd)
    kept = base.any(axis=(0, 2))
    assert 0 < kept.sum() < kept.size
    for at, line in enumerate(golden):
        if not line.get("regressor"):
            continue
        expected = np.array(line["regressor"]).reshape(arm.n, 10, arm.n).swapaxes(1, 2)
        near(blocks[at], expected)
        near(base[at], np.where(kept[:, None, :], expected, 0.0))


def test_payloads():
    arm = load("geared_6")
    q, qd, qdd, tau = (column("geared_6.jsonl", key) for key in ("q", "qd", "qdd", "tau"))
    for at, line in list(enumerate(lines("geared_6.payload.jsonl")))[::10]:
        xx, xy, xz, yy, yz, zz = line["inertia"]
        carrying = arm.carrying(line["mass"][0], line["com"], [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        state = slice(at, at + 1)
        near(upper(carrying.mass_matrix(q[state])), [line["mass_matrix"]])
        near(carrying.inverse_dynamics(q[state], qd[state], qdd[state]), [line["inverse_dynamics"]])
        near(carrying.gravity_torque(q[state]), [line["gravity_torque"]])
        near(carrying.forward_dynamics(q[state], qd[state], tau[state]), [line["forward_dynamics"]])
