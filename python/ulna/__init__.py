"""Dynamics of robot arms from a table, and what a joint that locks does to them.

    import numpy as np
    import ulna

    arm = ulna.load("arm.toml")               # or "robot.urdf", tip="hand"
    M = arm.mass_matrix(np.zeros(arm.n))      # (n, n), kg m^2
    q = np.random.uniform(-3, 3, (1000, arm.n))
    M = arm.mass_matrix(q, threads=0)         # (1000, n, n), on all cores

SI units and radians throughout. Twists and wrenches are linear first, ``[v; w]`` and ``[f; n]``, in world axes, at the tool point.
"""

from ._arm import Arm, Limits, Payload
from ._load import load, parse
from ._reports import Deviation, Report, Verification
from ._ulna import (
    DescriptionError,
    Error,
    Finding,
    TableError,
    TableWarning,
    set_threads,
    threads,
)

__all__ = [
    "Arm",
    "DescriptionError",
    "Deviation",
    "Error",
    "Finding",
    "Limits",
    "Payload",
    "Report",
    "TableError",
    "TableWarning",
    "Verification",
    "load",
    "parse",
    "set_threads",
    "threads",
]
