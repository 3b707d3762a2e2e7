"""A robot description through ulna and through Pinocchio, each reading it by itself."""

import numpy as np
import pytest

import ulna

from conftest import URDF, states

pin = pytest.importorskip("pinocchio")


@pytest.fixture(scope="module")
def arm():
    return ulna.load(URDF, tip="hand")


@pytest.fixture(scope="module")
def model():
    """The fingers frozen where ulna freezes them: the first at 0, the second where its mimicry puts it."""
    whole = pin.buildModelFromUrdf(str(URDF))
    fingers = [whole.getJointId(name) for name in ("finger_1", "finger_2")]
    at = pin.neutral(whole)
    at[whole.joints[fingers[1]].idx_q] = 0.002
    reduced = pin.buildReducedModel(whole, fingers, at)
    # ulna smooths Coulomb's friction and counts it in the dynamics; here it is added by hand.
    return reduced


def of(model, q):
    """A joint that turns without end is (cos, sin) to Pinocchio."""
    configuration = pin.neutral(model)
    for joint, angle in zip(list(model.joints)[1:], q, strict=True):
        if joint.nq == 2:
            configuration[joint.idx_q : joint.idx_q + 2] = np.cos(angle), np.sin(angle)
        else:
            configuration[joint.idx_q] = angle
    return configuration


def test_the_same_arm(arm, model):
    data = model.createData()
    hand = model.getFrameId("hand")
    many = states(arm, 50)
    friction = arm.friction_torque(many.qd)
    found = {
        "pose": arm.forward_kinematics(many.q),
        "jacobian": arm.geometric_jacobian(many.q),
        "mass": arm.mass_matrix(many.q),
        "torque": arm.inverse_dynamics(many.q, many.qd, many.qdd),
        "acceleration": arm.forward_dynamics(many.q, many.qd, many.tau),
        "gravity": arm.gravity_torque(many.q),
        "coriolis": arm.coriolis_matrix(many.q, many.qd),
        "center": arm.center_of_mass(many.q),
        "kinetic": arm.kinetic_energy(many.q, many.qd),
    }
    by_q, _ = arm.inverse_dynamics_derivatives(many.q, many.qd, many.qdd)
    # The base is no link of the arm; Pinocchio counts it with the universe, and so not at all.
    for at in range(50):
        q, qd, qdd, tau = of(model, many.q[at]), many.qd[at], many.qdd[at], many.tau[at]
        pin.framesForwardKinematics(model, data, q)
        expected = {
            "pose": data.oMf[hand].homogeneous,
            "jacobian": pin.computeFrameJacobian(model, data, q, hand, pin.LOCAL_WORLD_ALIGNED),
            "mass": pin.crba(model, data, q),
            "torque": pin.rnea(model, data, q, qd, qdd) + friction[at],
            "acceleration": pin.aba(model, data, q, qd, tau - friction[at]),
            "gravity": pin.computeGeneralizedGravity(model, data, q),
            "coriolis": pin.computeCoriolisMatrix(model, data, q, qd),
            "center": pin.centerOfMass(model, data, q),
            "kinetic": pin.computeKineticEnergy(model, data, q, qd),
        }
        for quantity, value in expected.items():
            mine = np.asarray(found[quantity][at])
            scale = np.abs(value).max()
            assert np.abs(mine - value).max() < 1e-11 * scale, quantity
        derivatives, _, _ = pin.computeRNEADerivatives(model, data, q, qd, qdd)
        assert np.abs(by_q[at] - derivatives).max() < 1e-11 * np.abs(derivatives).max()
