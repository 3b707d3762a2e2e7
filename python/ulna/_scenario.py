"""The class ``Scenario``."""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np

from . import _ulna
from ._arm import Arm
from ._experiments import Operation, Plan
from ._methods import Array


class Experiment(NamedTuple):
    """A tool force and torque limits, tried with a scenario's motion."""

    section: str
    """Its number, such as ``"5.2"``."""
    title: str
    force: Array
    """The coefficients of t^0, t^1, ... of each component of ``[f; n]``, ``(6, k)``, N and N m per s^k."""
    lock_step: Array
    """What the lock takes from it, before minus after, ``(6,)``."""
    rated_torque: Array | None
    """N m (N), ``(n,)``; None for no limit."""


class Scenario:
    """A file's scenario (TOML, as ``ulna help scenario`` has it): an arm, its motion, a lock, experiments. Joints count from 0 here.

    An arm that a scenario calls by name is one of :func:`ulna.arms`. Scenarios pickle, with the table that they name.
    """

    __slots__ = ("_arm", "_native")

    def __init__(self, native: _ulna.Scenario) -> None:
        self._native = native
        self._arm = Arm(native.arm)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scenario:
        """The scenario of a file.

        Raises:
            ScenarioError: every error in it and in the table that it names.
        """
        return cls(_ulna.read_scenario(path, None))

    @classmethod
    def parse(cls, text: str, source: str | os.PathLike[str] = "scenario.toml") -> Scenario:
        """The scenario of a text, as of a file ``source``, beside which its table is looked for."""
        return cls(_ulna.read_scenario(source, text))

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, self._native.state

    def __repr__(self) -> str:
        return f"<ulna.Scenario {self.name}: {self.arm.name}, joints {self.failed_joints} lock at {self.failure_times} s>"

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def description(self) -> str:
        """A sentence about it."""
        return self._native.description

    @property
    def arm(self) -> Arm:
        """The arm that moves."""
        return self._arm

    @property
    def failed_joints(self) -> list[int]:
        """The joints that lock together, counted from 0."""
        return self._native.failed_joints

    @property
    def failure_times(self) -> list[float]:
        """When they lock, s."""
        return self._native.failure_times

    @property
    def cycle(self) -> float:
        """The control cycle, s."""
        return self._native.cycle

    @property
    def experiments(self) -> list[Experiment]:
        """What is tried with the motion."""
        return [
            Experiment(section, title, _padded(force), np.array(step), None if rated is None else np.array(rated))
            for section, title, force, step, rated in self._native.experiments
        ]

    def plan(self) -> Plan:
        """The planned motion."""
        return Plan(self._native.plan())

    def operation(self, section: str, time: float) -> Operation:
        """The motion with the lock of an experiment at ``time`` s in it."""
        return Operation(self._native.operation(section, time))

    def study(self, section: str, time: float) -> dict[str, Any]:
        """Every search for one experiment and one failure time, each with the whole motion under its controller.

        Returns:
            ``section``, ``failure_time``; ``cases``, of ``"eq16_steps"``, ``"eq16"``, ``"eq20_steps"``, ``"eq20"`` and ``"optimal"`` each
            ``impact_before``, ``impact_after``, ``suppression_percent``, ``coefficients`` and ``max_torque`` ``(n,)``,
            ``healthy_impact_before`` and ``healthy_impact_after``, ``force_error``, ``max_force_error``, ``status``, ``infeasible`` (why there
            is no compensation, or None), and ``series``: ``time`` ``(k,)``, ``planned`` and ``torque`` ``(k, n)``, ``force`` and
            ``force_error`` ``(k, 6)``; ``frontier``, ``force_error`` against ``impact``.
        """
        return self._native.study(section, time)

    def simulated_lock(self, section: str, time: float) -> dict[str, Any]:
        """What the arm really does with brakes that take time, in one experiment at one failure time, without compensation and with three.

        Returns:
            ``runs``, of ``"none"`` and of methods each ``time`` ``(k,)``, ``torque`` and ``predicted_torque`` ``(k, n)``, ``torque_step``,
            ``predicted_step``, ``peak_torque`` ``(n,)``; ``unfinished``; ``convergence`` with ever shorter brakes; and what it was run with.
        """
        return self._native.simulated_lock(section, time)

    def assess(self, *, threads: int | None = None) -> dict[str, Any]:
        """Every law over failures for which it was not tuned: what ``ulna assess`` writes to ``assess.json``, joints counted from 0.

        Returns:
            ``arm``, ``scenario``, ``failure_times``; ``laws``, a list of dictionaries with ``law``, ``tuned``, ``force_budget``, ratios, and
            ``cases``, a table of columns for ``pandas.DataFrame``; ``ground_truth``.
        """
        return self._native.assess(threads)


def _again(text: str, source: str | os.PathLike[str], table: str) -> Scenario:
    """The scenario that was in another process, with the text of its arm's table."""
    return Scenario(_ulna.restore_scenario(text, source, table))


def _padded(force: list[list[float]]) -> Array:
    """Coefficients of six components, as many of each."""
    powers = max(map(len, force), default=0)
    return np.array([component + [0.0] * (powers - len(component)) for component in force])
