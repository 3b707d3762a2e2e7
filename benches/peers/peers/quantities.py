"""What is compared, timed and counted."""

# quantity -> how many numbers it is for n joints
QUANTITIES = {
    "geometric_jacobian": lambda n: 6 * n,
    "mass_matrix": lambda n: n * n,
    "mass_matrix_derivatives": lambda n: n**3,
    "dynamic_manipulability_gradient": lambda n: 1 + n,
    "inverse_dynamics": lambda n: n,
    "forward_dynamics": lambda n: n,
}
