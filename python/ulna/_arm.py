"""The class ``Arm``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _ulna
from ._experiments import Plan
from ._methods import Array, Methods
from ._numbers import floats, for_each_joint, wrench_of
from ._reports import Deviation, Report, Verification


class Limits(NamedTuple):
    """What the joints' limits are; infinite where the table states none."""

    lower: Array
    """Lowest coordinates, ``(n,)``, rad (m)."""
    upper: Array
    """Highest coordinates, ``(n,)``, rad (m)."""
    velocity: Array
    """Highest rates, ``(n,)``, rad/s (m/s)."""


class Payload(NamedTuple):
    """A rigid body that the tool holds, in the tool's frame."""

    mass: float
    """kg."""
    com: Array
    """Centroid, ``(3,)``, m."""
    inertia: Array
    """Inertia about the centroid, ``(3, 3)``, kg m^2."""


class Arm(Methods):
    """An arm of ``n`` joints: its kinematics, its dynamics, their derivatives; made by :func:`ulna.load` or :func:`ulna.parse`.

    Every method takes arrays ``(n,)`` or ``(..., n)`` of anything that float64 can hold, which are broadcast against each other but for the
    last axis, and returns arrays with the same leading axes. A matrix's last two axes are rows and columns, as views in Fortran's order
    where nothing else is asked for; a pose is a 4x4 homogeneous matrix. Results of several parts are tuples.

    ``out=`` takes the array, or the tuple of arrays, that results go to. ``threads=`` says how many threads work on a batch: 1 unless
    :func:`ulna.set_threads` says otherwise, 0 for all cores. Python's lock is released meanwhile.

    The first call of a method turns all of them into machine code, which takes some hundredths of a second.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _ulna.Arm) -> None:
        self._native = native

    def _call(self, method: str, arguments: tuple[ArrayLike, ...], out: Any, threads: int | None) -> Any:
        return self._native.call(method, arguments, out, threads)

    def __repr__(self) -> str:
        carrying = f", carrying {self.payload.mass:g} kg" if self.payload else ""
        return f"<ulna.Arm {self.name}: {self.n} joints{carrying}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.table, self.file, tuple(self.notes), self.payload)

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def n(self) -> int:
        """How many joints it has."""
        return self._native.n

    @property
    def joint_names(self) -> list[str]:
        """What its joints are called, base first."""
        return self._native.joint_names

    @property
    def joint_kinds(self) -> list[str]:
        """``"revolute"`` or ``"prismatic"``, base first."""
        return self._native.joint_kinds

    @property
    def limits(self) -> Limits:
        """Limits of the joints, infinite where there are none."""
        return Limits(*map(np.array, self._native.limits))

    @property
    def rated_torque(self) -> Array:
        """Rated torques of the joints, ``(n,)``, N m (N); infinite where the table states none."""
        return np.array(self._native.rated_torque)

    @property
    def gravity(self) -> Array:
        """Gravity, ``(3,)``, m/s^2, in world axes."""
        return np.array(self._native.gravity)

    @property
    def task(self) -> list[str]:
        """The rows of J in w_D: of ``x``, ``y``, ``z``, ``rx``, ``ry``, ``rz``."""
        return self._native.task

    @property
    def base(self) -> Array:
        """``world_from_base``, ``(4, 4)``."""
        return np.array(self._native.ends[0])

    @property
    def tool(self) -> Array:
        """``frame_n_from_tool``, ``(4, 4)``."""
        return np.array(self._native.ends[1])

    @property
    def table(self) -> str:
        """The arm's table as a text; of a robot description, the one that it becomes."""
        return self._native.table

    @property
    def file(self) -> str:
        """The file that it was read from."""
        return self._native.file

    @property
    def notes(self) -> list[str]:
        """The liberties that were taken with a robot description, a sentence each."""
        return self._native.notes

    @property
    def takes_payload(self) -> bool:
        """Whether its table says ``[payload] runtime = true``, so that :meth:`carrying` can be called."""
        return self._native.takes_payload

    @property
    def payload(self) -> Payload | None:
        """What it carries, if :meth:`carrying` made it."""
        payload = self._native.payload
        if payload is None:
            return None
        mass, com, inertia = payload
        return Payload(mass, np.array(com), np.array(inertia))

    def carrying(self, mass: float, com: ArrayLike = (0.0, 0.0, 0.0), inertia: ArrayLike | None = None) -> Arm:
        """The same arm with a body in its tool; both share their code.

        Args:
            mass: kg.
            com: its centroid in the tool's frame, ``(3,)``, m.
            inertia: about the centroid in the tool's axes, ``(3, 3)``, kg m^2; without it the body is a point.

        Raises:
            ValueError: no rigid body is like that, the arm cannot carry it, or its table gives it no payload at run time.
        """
        tensor = np.zeros((3, 3)) if inertia is None else inertia
        return Arm(self._native.carrying(mass, floats("com", com, (3,)), floats("inertia", tensor, (3, 3))))

    def impact_torque(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, joints: Sequence[int], *, wrench_step: ArrayLike = (0.0, 0.0, 0.0)
    ) -> Array:
        """What the motors feel when ``joints`` stop dead, all at once, before minus after (Eq. 12).

        Args:
            q: joint coordinates, ``(..., n)``, rad (m).
            qd: their rates, ``(..., n)``.
            qdd: their accelerations, ``(..., n)``.
            joints: those that lock, counted from 0.
            wrench_step: what the lock takes from what the tool exerts, ``(3,)`` N or ``(6,)`` N and N m, in world axes (Eq. 8).

        Returns:
            N m (N), ``(..., n)``. Of each joint alone :meth:`lock_impacts` is quicker.
        """
        return self._lock(q, qd, qdd, joints, wrench_step)[0]

    def structure_loads(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, joints: Sequence[int], *, wrench_step: ArrayLike = (0.0, 0.0, 0.0)
    ) -> tuple[Array, Array]:
        """What every link transmits to the next when ``joints`` stop dead, before minus after (Eq. 8-11); arguments as of :meth:`impact_torque`.

        Returns:
            Forces, N, and moments about the joint's frame's origin, N m, ``(..., n, 3)``, in that frame, whose z is the axis.
        """
        _, force, moment = self._lock(q, qd, qdd, joints, wrench_step)
        return force, moment

    def _lock(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, joints: Sequence[int], wrench_step: ArrayLike
    ) -> tuple[Array, Array, Array]:
        lock = {"joints": list(joints), "wrench_step": wrench_of("wrench_step", wrench_step)}
        torque, force, moment = _ulna.lock_impact(self._native, (q, qd, qdd), lock)
        return torque, force, moment

    def control_cycle(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        law: _ulna.Law,
        *,
        wrench: ArrayLike = (0.0, 0.0, 0.0),
        locked: Sequence[int] = (),
        rated_torque: ArrayLike | None = None,
        projector: str = "static",
    ) -> dict[str, Any]:
        """A cycle of the suppression controller at each state: the torques of an arm whose tool is to exert ``wrench``.

        Args:
            q, qd, qdd: the planned states, ``(..., n)``.
            law: the compensation.
            wrench: ``(3,)`` N or ``(6,)`` N and N m, in world axes at the tool point.
            locked: joints that stand still whatever the state says, counted from 0.
            rated_torque: N m (N), one number or ``(n,)``; those of the arm's table without it.
            projector: ``"static"`` or ``"dynamically_consistent"``.

        Returns:
            ``torque``, ``planned`` (without compensation), ``compensation`` and ``margins``, ``(..., n)``; ``force_error``, ``(..., 6)``;
            ``conditioning``; ``status``, a word or a list of them.
        """
        cycle = {
            "wrench": wrench_of("wrench", wrench),
            "locked": list(locked),
            "rated_torque": for_each_joint("rated_torque", rated_torque, self.n),
            "projector": projector,
        }
        return _ulna.control_cycle(self._native, (q, qd, qdd), law, cycle)

    def plan(
        self,
        start: ArrayLike,
        goal: ArrayLike | None = None,
        *,
        displacement: ArrayLike | None = None,
        duration: float,
        blend: float,
        profile: str = "trapezoid",
        jerk_time: float | None = None,
        max_acceleration: ArrayLike | None = None,
    ) -> Plan:
        """A motion from rest to rest, straight in joint space or of the tool, within the limits of the arm's table.

        Args:
            start: q, ``(n,)``, rad (m).
            goal: q where it ends, ``(n,)``; or else
            displacement: what the tool is moved by, ``(3,)`` m or ``(6,)`` m and rad, a rotation vector, in world axes.
            duration: s.
            blend: of speeding up, and again of slowing down, s.
            profile: ``"trapezoid"``, ``"quintic"`` or ``"s_curve"``.
            jerk_time: of an S-curve, s; a third of the blend without it.
            max_acceleration: ``(n,)`` or one number, rad/s^2 (m/s^2).

        Raises:
            ExperimentError: too fast or too far for a joint, or through a singular pose.
        """
        if (goal is None) == (displacement is None):
            raise TypeError("plan: expected either goal or displacement")
        asked = {
            "start": floats("start", start, (self.n,)),
            "goal": None if goal is None else floats("goal", goal, (self.n,)),
            "displacement": wrench_of("displacement", (0.0, 0.0, 0.0) if displacement is None else displacement),
            "duration": duration,
            "blend": blend,
            "profile": profile,
            "jerk_time": blend / 3.0 if jerk_time is None else jerk_time,
            "max_acceleration": for_each_joint("max_acceleration", max_acceleration, self.n),
        }
        return Plan(_ulna.plan_motion(self._native, asked))

    @overload
    def generate(self, language: Literal["rust"] = "rust", *, methods: Sequence[str] | None = None) -> str: ...

    @overload
    def generate(
        self,
        language: Literal["c"],
        *,
        methods: Sequence[str] | None = None,
        precision: str = "double",
        abi: str | None = None,
        function_length: int = 2000,
    ) -> tuple[str, str]: ...

    def generate(
        self,
        language: str = "rust",
        *,
        methods: Sequence[str] | None = None,
        precision: str = "double",
        abi: str | None = None,
        function_length: int = 2000,
    ) -> str | tuple[str, str]:
        """The arm's code, as ``ulna generate`` writes it.

        Args:
            language: ``"rust"`` or ``"c"``.
            methods: the methods that are generated, all without it. Others run by the textbook's formulas in Rust, and are not there in C.
            precision: of C: ``"double"`` or ``"float"``.
            abi: of C: ``"casadi"`` for the functions that ``casadi.external`` looks for besides.
            function_length: of C: the most statements of a function.

        Returns:
            Rust's text; of C the header's, ``NAME.h``, and the source file's, ``NAME.c``.
        """
        if language == "rust":
            return self._native.generate_rust(methods)
        if language != "c":
            raise ValueError(f'language: expected "rust" or "c", found {language!r}')
        if precision not in ("double", "float"):
            raise ValueError(f'precision: expected "double" or "float", found {precision!r}')
        if abi not in (None, "casadi"):
            raise ValueError(f'abi: expected "casadi", found {abi!r}')
        options = {"float": precision == "float", "casadi": abi == "casadi", "function_length": function_length}
        return self._native.generate_c(methods, options)

    def cost(self, *, methods: Sequence[str] | None = None) -> dict[str, Any]:
        """The operations of each method, as ``ulna cost --json`` gives them.

        Returns:
            ``{"arm", "quantities": {method: {"add", "sub", "mul", ..., "sin_cos", "total"}}}``; ``total`` is without ``sin_cos``.
        """
        return self._native.cost(methods)

    def verify(self, samples: int = 100, *, methods: Sequence[str] | None = None) -> Verification:
        """Compares the arm's programs and the textbook with 106 bits, and derivatives with differences, at random states.

        Args:
            samples: how many states, the same ones every time; 100 of them take seconds, and of arms of 30 joints minutes.
            methods: which are compared, all without it.
        """
        if samples < 1:
            raise ValueError(f"samples: expected 1 or more, found {samples}")
        reports = self._native.verify(samples, methods)
        return Verification(
            *(
                Report(text, passes, states, tuple(Deviation(*it) for it in deviations))
                for text, passes, states, deviations in reports
            )
        )


def _again(table: str, file: str, notes: tuple[str, ...], payload: Payload | None) -> Arm:
    """An arm that was pickled. What its table is warned of has been said."""
    arm = Arm(_ulna.restore(table, file, list(notes)))
    return arm if payload is None else arm.carrying(*payload)
