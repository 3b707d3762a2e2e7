"""What holds between methods, for those that no number from outside is at hand for, and for every method's derivative."""

import numpy as np

from conftest import states


def test_wrenches_come_in_by_the_jacobian(arm):
    q, qd, qdd, tau, wrench = states(arm, 30)
    pulled = np.einsum("src,sr->sc", arm.geometric_jacobian(q), wrench)
    np.testing.assert_allclose(
        arm.inverse_dynamics_with_wrench(q, qd, qdd, wrench), arm.inverse_dynamics(q, qd, qdd) - pulled, rtol=1e-9, atol=1e-9
    )
    accelerations = arm.forward_dynamics_with_wrench(q, qd, tau, wrench)
    np.testing.assert_allclose(arm.inverse_dynamics_with_wrench(q, qd, accelerations, wrench), tau, rtol=1e-8, atol=1e-8)


def test_inverse_and_forward_dynamics_undo_each_other(arm):
    q, qd, qdd, *_ = states(arm, 30)
    tau = arm.inverse_dynamics(q, qd, qdd)
    np.testing.assert_allclose(arm.forward_dynamics(q, qd, tau), qdd, rtol=1e-7, atol=1e-7)
    identity = arm.mass_matrix(q) @ arm.inverse_mass_matrix(q)
    np.testing.assert_allclose(identity, np.broadcast_to(np.eye(arm.n), identity.shape), atol=1e-8)


def test_gradients_are_those_of_what_they_are_gradients_of(arm):
    """Central differences along random directions, a batch each way."""
    q, qd, *_ = states(arm, 30)
    step = 1e-5
    pairs = [
        (arm.dynamic_manipulability, arm.dynamic_manipulability_gradient(q)[1][:, :, None]),
        (arm.potential_energy, arm.gravity_torque(q)[:, :, None]),
        (lambda q: arm.forward_kinematics(q)[:, :3, 3], arm.geometric_jacobian(q)[:, :3].swapaxes(1, 2)),
        (lambda q: arm.mass_matrix(q).reshape(30, -1), arm.mass_matrix_derivatives(q).reshape(30, arm.n, -1)),
    ]
    for method, gradient in pairs:
        slope = np.einsum("sik,si->sk", gradient, qd).reshape(30, -1)
        difference = (method(q + step * qd) - method(q - step * qd)).reshape(30, -1) / (2 * step)
        scale = np.abs(gradient).max(axis=(1, 2)).reshape(30, 1) + 1e-30
        assert (np.abs(slope - difference) / scale).max() < 1e-6
