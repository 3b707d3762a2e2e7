"""Plans, locks, searches and simulations of an arm of one's own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from . import _ulna
from ._methods import Array
from ._numbers import floats, for_each_joint, wrench_of

if TYPE_CHECKING:
    from ._ulna import Law


class Plan:
    """A motion that an arm can execute, from rest to rest: made by :meth:`ulna.Arm.plan` or :meth:`ulna.Scenario.plan`."""

    __slots__ = ("_native",)

    def __init__(self, native: _ulna.Plan) -> None:
        self._native = native

    def __repr__(self) -> str:
        return f"<ulna.Plan of {self.duration:g} s, {self._native.n} joints>"

    @property
    def duration(self) -> float:
        """s."""
        return self._native.duration

    def states(self, times: ArrayLike) -> tuple[Array, Array, Array]:
        """Where the joints are planned to be: q, qd and qdd, ``(k, n)`` each, rad, rad/s and rad/s^2 (m for sliding joints).

        Args:
            times: s, ``(k,)``. Where an acceleration jumps, its value after the jump; before and after the motion the arm rests.
        """
        q, qd, qdd = self._native.states(np.asarray(times, dtype=float).ravel().tolist())
        return q, qd, qdd

    def lock(
        self,
        joints: Sequence[int],
        time: float,
        *,
        force: ArrayLike = (0.0, 0.0, 0.0),
        lock_step: ArrayLike = (0.0, 0.0, 0.0),
        rated_torque: ArrayLike | None = None,
        projector: str = "static",
        sample_period: float = 0.05,
        step_time: float = 0.0,
        effort: float | None = None,
    ) -> Operation:
        """The motion with a lock in it.

        Args:
            joints: those that lock together, counted from 0.
            time: when, s.
            force: what the tool exerts, ``(3,)`` N or ``(6,)`` N and N m, in world axes; ``(6, k)`` are the coefficients of
                t^0, t^1, ... of each component.
            lock_step: what the lock takes from it, before minus after (Eq. 8), ``(3,)`` or ``(6,)``.
            rated_torque: N m (N), one number or ``(n,)``; no limit without it.
            projector: ``"static"``, the paper's, or ``"dynamically_consistent"`` (Khatib 1987).
            sample_period: the largest time between two times that a search looks at, s.
            step_time: the Delta t of Eq. 18, s.
            effort: how many N m of impact a N m of compensation weighs as; a thousandth without it.

        Raises:
            ExperimentError: the lock is not in the motion, or a joint is none of the arm's.
        """
        lock = {
            "joints": list(joints),
            "time": time,
            "force": _powers(force),
            "lock_step": wrench_of("lock_step", lock_step),
            "rated_torque": for_each_joint("rated_torque", rated_torque, self._native.n),
            "projector": projector,
            "sample_period": sample_period,
            "step_time": step_time,
            "effort": effort,
        }
        return Operation(self._native.lock(lock))


class Operation:
    """A planned motion with a lock in it: searches for a compensation, and what the arm really does.

    Impacts are those of Eq. 18, after minus before, N m (N).
    """

    __slots__ = ("_native",)

    def __init__(self, native: _ulna.Operation) -> None:
        self._native = native

    def __repr__(self) -> str:
        return f"<ulna.Operation: joints {self.joints} lock at {self.time:g} s>"

    @property
    def joints(self) -> list[int]:
        """The joints that lock, counted from 0."""
        return self._native.joints

    @property
    def time(self) -> float:
        """When they lock, s."""
        return self._native.time

    @property
    def step(self) -> Array:
        """The step of each joint's torque without compensation, ``(n,)``."""
        return self._native.step

    def search(
        self, method: str = "optimal", *, min_max: bool = False, force_error: float = 0.0, step: float = 1e6
    ) -> dict[str, Any]:
        """Searches for a compensation.

        Args:
            method: ``"eq16"`` or ``"eq20"`` for the exact coefficients of the paper's laws, ``"eq16_steps"`` or ``"eq20_steps"`` for the
                paper's search (Figure 2), ``"optimal"`` for the best compensation there is.
            min_max: of ``"eq20"``: the largest step least, and not the norm.
            force_error: of ``"optimal"``: how far the static tool force may be bent, N.
            step: of the paper's search.

        Returns:
            ``law`` (:class:`Law`), ``impact`` ``(n,)``, ``healthy_impact`` (the norm over joints that do not lock), ``force_error_before`` and
            ``force_error_after`` ``(6,)``, ``max_force_error``, ``peak_torque`` and ``peak_compensation`` ``(n,)``, ``least_margin``,
            ``status``, ``gap``, ``iterations``, ``seconds``.

        Raises:
            ExperimentError: nothing keeps the limits, or the solver stops without an answer.
        """
        return self._native.search(method, min_max, force_error, step)

    def assess(self, law: Law) -> dict[str, Any]:
        """What a law does, cut at rated torques as a control cycle cuts it: as :meth:`search` returns it, without how it was found."""
        return self._native.assess(law)

    def simulate(
        self,
        law: Law | None = None,
        *,
        start: float | None = None,
        end: float | None = None,
        gain: float = 5.0,
        cycle: float | None = 0.001,
        brake_time: float = 0.1,
        brake_profile: str = "constant",
        detection: float = 0.0,
        reflected_inertia: ArrayLike | None = None,
        tolerance: float = 1e-10,
        sample_period: float = 0.01,
    ) -> dict[str, Any]:
        """What the arm really does while joints are braked and locked.

        Args:
            law: the compensation; none without it.
            start: where it begins, in the planned state, s; a second before the lock without it.
            end: where it ends, s; a second after the brake without it.
            gain: how fast departures from the plan die out, critically damped, rad/s; 0 is no feedback.
            cycle: the control cycle, s; None for a controller that acts at all times.
            brake_time: from moving to locked, s.
            brake_profile: how the rate falls in that time, ``"constant"`` deceleration or ``"smooth"``.
            detection: from the lock until the controller knows, s.
            reflected_inertia: rotors as the joints feel them where the table does not have them, one number or ``(n,)``, kg m^2 (kg).
            tolerance: of a step of the integration.
            sample_period: the largest time between two samples, s.

        Returns:
            ``time`` ``(k,)``, s; ``q``, ``qd``, ``qdd``, ``planned_q``, ``planned_qd``, ``motor``, ``brake`` and ``joint_torque`` (what each
            joint transmits), ``(k, n)``, two rows where something jumps; ``ending``, ``impact`` (or None), ``energy_error``,
            ``momentum_error``, ``status``, ``steps``.
        """
        run = {
            "start": max(0.0, self.time - 1.0) if start is None else start,
            "end": self.time + brake_time + 1.0 if end is None else end,
            "gain": gain,
            "cycle": cycle,
            "brake_time": brake_time,
            "brake_profile": brake_profile,
            "detection": detection,
            "reflected_inertia": for_each_joint("reflected_inertia", reflected_inertia, len(self.step)),
            "tolerance": tolerance,
            "sample_period": sample_period,
        }
        return self._native.simulate(_ulna.Law.none() if law is None else law, run)


def _powers(force: ArrayLike) -> list[list[float]]:
    """The coefficients of each of six components."""
    array = np.asarray(force, dtype=float)
    if array.ndim == 2:
        return floats("force", array, (6, array.shape[1]))
    return [[component] for component in wrench_of("force", array)]
