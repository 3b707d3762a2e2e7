"""What is compared and timed."""

from collections.abc import Callable
from dataclasses import dataclass, field

PINOCCHIO, CASADI = "Pinocchio", "CasADi, our formulation"
PAIRS, ONE_MORE = "ulna, 2N inverse dynamics", "ulna, N + 1 inverse dynamics"


@dataclass(frozen=True)
class Quantity:
    title: str
    size: Callable[[int], int]  # how many numbers it is for n joints
    least: dict[str, float] = field(default_factory=dict)  # a peer -> how many times ulna's time it is expected to take


# Method of `Arm` -> what it is. One that ulna does not have is left out, and named.
QUANTITIES = {
    "geometric_jacobian": Quantity("J, six rows", lambda n: 6 * n),
    "mass_matrix": Quantity("M", lambda n: n * n),
    "mass_matrix_derivatives": Quantity("all ∂M/∂q_i", lambda n: n**3),
    "dynamic_manipulability_gradient": Quantity("w_D and ∇w_D", lambda n: 1 + n),
    "inverse_dynamics": Quantity("inverse dynamics", lambda n: n),
    "forward_dynamics": Quantity("forward dynamics", lambda n: n),
    "link_poses": Quantity("link poses", lambda n: 12 * n, {PINOCCHIO: 6, CASADI: 1.5}),
    "link_jacobians": Quantity("link Jacobians", lambda n: 6 * n * n),
    "center_of_mass": Quantity("centre of mass", lambda n: 3),
    "jacobian_rate": Quantity("dJ/dt", lambda n: 6 * n),
    "bias_acceleration": Quantity("dJ/dt q̇", lambda n: 6),
    "inverse_mass_matrix": Quantity("M⁻¹", lambda n: n * n, {PINOCCHIO: 6, CASADI: 1.5}),
    "coriolis_matrix": Quantity("C", lambda n: n * n, {PINOCCHIO: 6, CASADI: 1.5}),
    "kinetic_energy": Quantity("kinetic energy", lambda n: 1),
    "potential_energy": Quantity("potential energy", lambda n: 1),
    "task_space_inertia": Quantity("task-space inertia Λ", lambda n: 36),
    "dynamically_consistent_inverse": Quantity("dynamically consistent inverse", lambda n: 6 * n),
    "manipulability_gradient": Quantity("w and ∇w", lambda n: 1 + n),
    "inverse_dynamics_derivatives": Quantity("inverse dynamics' derivatives", lambda n: 2 * n * n, {PINOCCHIO: 6, CASADI: 1.5}),
    "forward_dynamics_derivatives": Quantity("forward dynamics' derivatives", lambda n: 3 * n * n, {PINOCCHIO: 6, CASADI: 1.5}),
    "regressor": Quantity("regressor", lambda n: 10 * n * n, {PINOCCHIO: 6, CASADI: 1.3}),
    "base_regressor": Quantity("regressor of base parameters", lambda n: 10 * n * n),
    "lock_impacts": Quantity("lock impacts", lambda n: n * n, {PAIRS: 3}),
}
