"""What the tests share: arms, which are read and compiled once, and states to call them at."""

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

import ulna
from ulna import _ulna

ROOT = Path(__file__).parents[2]
URDF = ROOT / "urdf" / "tests" / "robots" / "arm_with_gripper.urdf"

#: The table of methods: of each its arguments, and the axes of its parts.
TABLE = {name: ([argument for argument, _ in arguments], parts) for name, arguments, _, parts in _ulna.methods()}


class States(NamedTuple):
    """States of an arm, an array for each argument of a method."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    wrench: np.ndarray

    def of(self, method, at=slice(None)):
        """The arguments of ``method``."""
        return [getattr(self, argument)[at] for argument in TABLE[method][0]]


@cache
def load(name):
    """The arm of ``arms/NAME.toml``."""
    return ulna.load(ROOT / "arms" / f"{name}.toml")


def states(arm, count, seed=0):
    random = np.random.default_rng(seed)
    vectors = random.uniform(-1.0, 1.0, (4, count, arm.n))
    vectors[0] *= np.where(np.array(arm.joint_kinds) == "revolute", np.pi, 1.0)
    return States(*vectors, random.uniform(-1.0, 1.0, (count, 6)))


def parts_of(result):
    """The arrays of a result, one or several."""
    return result if isinstance(result, tuple) else (result,)


@pytest.fixture(params=["ssrms", "geared_6"])
def arm(request):
    return load(request.param)


@pytest.fixture
def small():
    return load("planar_2r")
