"""The methods of an arm. Written by ``tools/write_methods.py`` from the table of methods in ``src/arm/methods.rs``; not to be edited."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Doubles.
Array = NDArray[np.float64]


class Methods:
    """Every method of an arm of ``n`` joints; :class:`Arm` says what they have in common."""

    __slots__ = ()

    def _call(self, method: str, arguments: tuple[ArrayLike, ...], out: Any, threads: int | None) -> Any:
        raise NotImplementedError

    def forward_kinematics(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Pose of the tool, ``world_from_tool``.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., 4, 4)``.
        """
        return self._call("forward_kinematics", (q,), out, threads)

    def link_poses(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Where the links are: ``world_from_link_i``, one pose for each link, base first; frame i is that of modified DH, whose z is joint i's
        axis.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, 4, 4)``.
        """
        return self._call("link_poses", (q,), out, threads)

    def geometric_jacobian(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Geometric Jacobian J, 6×N: ``[v; ω] = J q̇``. All six rows, whatever the task.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., 6, n)``.
        """
        return self._call("geometric_jacobian", (q,), out, threads)

    def link_jacobians(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Geometric Jacobian of each link at the origin of its frame, 6×N in world axes: ``[v_i; ω_i] = J_i q̇``. Columns of joints beyond the
        link are 0.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, 6, n)``.
        """
        return self._call("link_jacobians", (q,), out, threads)

    def jacobian_derivatives(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """∂J/∂q_i, one 6×N matrix for each i.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, 6, n)``.
        """
        return self._call("jacobian_derivatives", (q,), out, threads)

    def jacobian_rate(
        self, q: ArrayLike, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """J̇, 6×N: the rate of the geometric Jacobian while the joints move, at the tool point, which moves with them.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            ``(..., 6, n)``.
        """
        return self._call("jacobian_rate", (q, qd,), out, threads)

    def bias_acceleration(
        self, q: ArrayLike, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """``J̇ q̇``: the tool's acceleration ``[v̇; ω̇]`` while the joints move at constant rates, m/s² and rad/s², world axes.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            ``(..., 6)``.
        """
        return self._call("bias_acceleration", (q, qd,), out, threads)

    def center_of_mass(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Centre of mass of all links, m, in world axes from the world's origin.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., 3)``.
        """
        return self._call("center_of_mass", (q,), out, threads)

    def mass_matrix(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Mass matrix M of ``τ = M q̈ + c(q, q̇) + g(q)``, N×N, full and symmetric, kg·m²: that of the links, and on its diagonal what the
        rotors behind their gears add.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, n)``.
        """
        return self._call("mass_matrix", (q,), out, threads)

    def mass_matrix_derivatives(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """∂M/∂q_i, one N×N matrix for each i.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, n, n)``.
        """
        return self._call("mass_matrix_derivatives", (q,), out, threads)

    def inverse_mass_matrix(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Inverse mass matrix M⁻¹, N×N, full and symmetric, 1/(kg·m²): ``q̈ = M⁻¹ τ`` at rest and without gravity.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, n)``.
        """
        return self._call("inverse_mass_matrix", (q,), out, threads)

    def coriolis_matrix(
        self, q: ArrayLike, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Coriolis matrix C, N×N, of Christoffel's symbols, kg·m²/s: the bias force is ``C q̇ + g``, and ``Ṁ = C + Cᵀ``, so that ``Ṁ − 2C`` is
        skew-symmetric.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            ``(..., n, n)``.
        """
        return self._call("coriolis_matrix", (q, qd,), out, threads)

    def kinetic_energy(
        self, q: ArrayLike, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Any:
        """Kinetic energy ``½ q̇ᵀ M q̇``, J.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            a number, or ``(...)``.
        """
        return self._call("kinetic_energy", (q, qd,), out, threads)

    def potential_energy(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Any:
        """Potential energy ``−Σ m_i gᵀ p_i`` of the links in gravity, J; p_i are their centroids from the world's origin, where it is 0.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a number, or ``(...)``.
        """
        return self._call("potential_energy", (q,), out, threads)

    def inverse_dynamics(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Inverse dynamics τ = M q̈ + c(q, q̇) + g(q) + f(q̇), N·m, f the joints' friction; without a tool wrench.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("inverse_dynamics", (q, qd, qdd,), out, threads)

    def inverse_dynamics_with_wrench(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, wrench: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Inverse dynamics with a wrench: τ = M q̈ + c(q, q̇) + g(q) + f(q̇) − Jᵀ F, N·m.

        F = ``[f; n]`` is what the environment exerts on the tool, at the tool point, in world axes, N and N·m.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.
            wrench: wrench on the tool, ``[f; n]``, N and N·m, ``(..., 6)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("inverse_dynamics_with_wrench", (q, qd, qdd, wrench,), out, threads)

    def bias_force(
        self, q: ArrayLike, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Bias force c(q, q̇) + g(q): the inverse dynamics at q̈ = 0, without friction.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("bias_force", (q, qd,), out, threads)

    def gravity_torque(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Gravity torque g(q): the inverse dynamics at q̇ = 0, q̈ = 0.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("gravity_torque", (q,), out, threads)

    def friction_torque(
        self, qd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Friction torque f(q̇), N·m: ``viscous · q̇_i + coulomb · q̇_i / √(q̇_i² + smoothing²)`` of each joint's ``Friction``.

        Inverse and forward dynamics have it in them, and nothing else has.

        Args:
            qd: joint rates, rad/s (m/s), ``(..., n)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("friction_torque", (qd,), out, threads)

    def forward_dynamics(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Forward dynamics q̈ = M⁻¹(τ − c(q, q̇) − g(q) − f(q̇)), f the joints' friction; without a tool wrench.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            tau: joint torques, N·m (N), ``(..., n)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("forward_dynamics", (q, qd, tau,), out, threads)

    def forward_dynamics_with_wrench(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, wrench: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Forward dynamics with a wrench: q̈ = M⁻¹(τ + Jᵀ F − c(q, q̇) − g(q) − f(q̇)).

        F = ``[f; n]`` is what the environment exerts on the tool, at the tool point, in world axes, N and N·m.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            tau: joint torques, N·m (N), ``(..., n)``.
            wrench: wrench on the tool, ``[f; n]``, N and N·m, ``(..., 6)``.

        Returns:
            ``(..., n)``.
        """
        return self._call("forward_dynamics_with_wrench", (q, qd, tau, wrench,), out, threads)

    def inverse_dynamics_derivatives(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Array, Array]:
        """∂τ/∂q and ∂τ/∂q̇ of the inverse dynamics, N×N each, N·m/rad and N·m·s/rad: entry (i, j) is ∂τ_i/∂q_j. ∂τ/∂q̈ is M.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.

        Returns:
            a tuple of ``(..., n, n)``, ``(..., n, n)``.
        """
        return self._call("inverse_dynamics_derivatives", (q, qd, qdd,), out, threads)

    def forward_dynamics_derivatives(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Array, Array, Array]:
        """∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ of the forward dynamics, N×N each: entry (i, j) is ∂q̈_i/∂q_j. The last is M⁻¹, the others are −M⁻¹ ∂τ/∂q
        and −M⁻¹ ∂τ/∂q̇ at q̈ = FD(q, q̇, τ) (Carpentier and Mansard, RSS 2018).

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            tau: joint torques, N·m (N), ``(..., n)``.

        Returns:
            a tuple of ``(..., n, n)``, ``(..., n, n)``, ``(..., n, n)``.
        """
        return self._call("forward_dynamics_derivatives", (q, qd, tau,), out, threads)

    def regressor(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Regressor Y of the inverse dynamics: ``τ = Σ_i Y_i π_i``, an N×10 block for each link i, π_i its inertial parameters about the
        origin of its frame (modified DH): m, m·c (x, y, z), then the inertia xx, xy, xz, yy, yz, zz.

        Links alone: what motors, friction or a payload add to the torque is no part of Y π. Block i is 0 in rows j > i, and no block
        depends on any link's parameters. (Atkeson, An and Hollerbach 1986; Khalil and Dombre, section 9.3.)

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.

        Returns:
            ``(..., n, n, 10)``.
        """
        return self._call("regressor", (q, qd, qdd,), out, threads)

    def base_regressor(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """The columns of the base (minimal) parameters as they are in ``Arm::regressor``, and 0 in all others: as many columns as Y stacked
        over all motions has independent ones.

        A base parameter is a standard parameter with multiples of others grouped into it, so its column is that of Y. Which parameters they
        are follows from the arm's geometry and gravity (``Parameter::BASE_ORDER`` tells the choice); generated types list them as
        ``BASE_PARAMETERS``, and ``ulna cost --base-parameters`` prints what is grouped into each. (Gautier and Khalil 1990; Gautier 1991.)

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.

        Returns:
            ``(..., n, n, 10)``.
        """
        return self._call("base_regressor", (q, qd, qdd,), out, threads)

    def lock_impacts(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Joint impact torques Δτ of a lock, N·m, before minus after (Eq. 1–12): column k holds those of all joints if joint k alone stopped
        dead now, ``Δτ = τ(q, q̇, q̈) − τ(q, q̇ − q̇_k e_k, q̈ − q̈_k e_k)`` with τ the inverse dynamics.

        N×N, without a change of the tool wrench. The column of a joint at rest is exactly 0. Of any set of joints that lock at once it is
        ``impact_torque`` that knows.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.
            qd: joint rates, rad/s (m/s), ``(..., n)``.
            qdd: joint accelerations, rad/s² (m/s²), ``(..., n)``.

        Returns:
            ``(..., n, n)``.
        """
        return self._call("lock_impacts", (q, qd, qdd,), out, threads)

    def dynamic_manipulability(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Any:
        """Dynamic manipulability ``w_D = √det((JM⁻¹)(JM⁻¹)ᵀ)`` over the task's rows of J (Eq. 15).

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a number, or ``(...)``.
        """
        return self._call("dynamic_manipulability", (q,), out, threads)

    def dynamic_manipulability_gradient(
        self, q: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Any, Array]:
        """w_D and its gradient ∇w_D (Eq. 22–27).

        Where w_D is 0, Eq. 23 has no value; the gradient returned there is the zero vector. ``arm::singular`` of the Rust crate ``ulna``
        says where that is.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a tuple of a number or ``(...)``, ``(..., n)``.
        """
        return self._call("dynamic_manipulability_gradient", (q,), out, threads)

    def manipulability_gradient(
        self, q: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Any, Array]:
        """Kinematic manipulability ``w = √det(JJᵀ)`` over the task's rows of J and its gradient ∇w (Yoshikawa 1985).

        Where the task is singular, w is 0 and the gradient returned is the zero vector.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a tuple of a number or ``(...)``, ``(..., n)``.
        """
        return self._call("manipulability_gradient", (q,), out, threads)

    def task_space_inertia(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Task-space inertia ``Λ = (J M⁻¹ Jᵀ)⁻¹`` over the task's rows (Khatib 1987), kg for rows of v and kg·m² for rows of ω.

        Rows and columns outside the task are 0. Where the task is singular, all of it is.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., 6, 6)``.
        """
        return self._call("task_space_inertia", (q,), out, threads)

    def dynamically_consistent_inverse(
        self, q: ArrayLike, *, out: Array | None = None, threads: int | None = None
    ) -> Array:
        """Dynamically consistent inverse ``J̄ = M⁻¹ Jᵀ Λ`` of the task's rows of J (Khatib 1987), N×6: of all joint motions with a given tool
        velocity, the one of least kinetic energy; ``J̄ᵀ`` takes joint torques to the tool force that they make.

        Columns outside the task are 0. Where the task is singular, all of it is.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            ``(..., n, 6)``.
        """
        return self._call("dynamically_consistent_inverse", (q,), out, threads)

    def mass_matrix_and_derivatives(
        self, q: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Array, Array]:
        """M and all ∂M/∂q_i in one call.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a tuple of ``(..., n, n)``, ``(..., n, n, n)``.
        """
        return self._call("mass_matrix_and_derivatives", (q,), out, threads)

    def jacobian_and_gradient(
        self, q: ArrayLike, *, out: tuple[Array, ...] | None = None, threads: int | None = None
    ) -> tuple[Array, Any, Array]:
        """J (six rows), w_D and ∇w_D in one call: what a cycle of the suppression controller needs.

        Args:
            q: joint coordinates, rad (prismatic: m), ``(..., n)``.

        Returns:
            a tuple of ``(..., 6, n)``, a number or ``(...)``, ``(..., n)``.
        """
        return self._call("jacobian_and_gradient", (q,), out, threads)
