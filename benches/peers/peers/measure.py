"""Agreement first, then times in turns."""

import ctypes
import subprocess
import sys

import numpy as np

from .arm import Arm
from .build import BUILD, HERE, Library
from .quantities import QUANTITIES

TOLERANCE = 1e-9

# Two of Pinocchio's ways to the same quantity; the faster one is reported.
VARIANTS = {"mass_matrix": ["local"], "geometric_jacobian": ["joints"]}

SINGLE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
BATCH = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_long, ctypes.c_void_p)
# States in a call of a batch kernel.
BLOCK = 64


class Kernel:
    """One quantity of one library."""

    def __init__(self, library: Library, arm: Arm, quantity: str, variant: str):
        self.library, self.quantity = library, quantity
        self.width, self.size = 3 * len(arm.joints), QUANTITIES[quantity](len(arm.joints))
        find = getattr(ctypes.CDLL(str(library.path)), library.symbol)
        find.argtypes, find.restype = [ctypes.c_char_p] * 2, ctypes.c_void_p
        self.address = find(arm.name.encode(), f"{quantity}{variant}".encode())
        self.kind = library.kind
        self.times = np.array([])

    def values(self, x):
        """The results for every row of x."""
        out = np.zeros((len(x), self.size))
        if self.kind == "batch":
            for states, results in zip(blocks(x), range(0, len(x), BLOCK)):
                BATCH(self.address)(states.ctypes.data, states.size // self.width, out[results:].ctypes.data)
            return out
        for state, result in zip(x, out):
            ends = state.ctypes.data, result.ctypes.data
            SINGLE(self.address)(*(ends if self.kind == "single" else reversed(ends)))
        return out


def blocks(x):
    """x in blocks of states, each laid out as q of all, qd of all, qdd of all."""
    for start in range(0, len(x), BLOCK):
        states = x[start : start + BLOCK]
        yield np.ascontiguousarray(states.reshape(len(states), 3, -1).transpose(1, 0, 2))


def kernels(libraries, arm):
    every = (
        Kernel(library, arm, quantity, variant)
        for library in libraries
        for quantity in QUANTITIES
        for variant in ["", *(f"/{v}" for v in VARIANTS.get(quantity, []))]
    )
    return [kernel for kernel in every if kernel.address]


def inputs(arm, count, seed):
    """q within half a turn (a metre), rates and accelerations or torques of order one."""
    random = np.random.default_rng(seed)
    q = random.uniform(-np.pi, np.pi, (count, len(arm.joints)))
    for i, joint in enumerate(arm.joints):
        if not joint.revolute:
            q[:, i] /= np.pi
    return np.hstack([q, random.uniform(-1, 1, (count, 2 * len(arm.joints)))])


def agreement(kernels, arm, count=300, seed=1):
    """The largest relative difference of each library from the median of all, by quantity; stops where one is too large."""
    x, worst = inputs(arm, count, seed), {}
    for quantity in QUANTITIES:
        same = [kernel for kernel in kernels if kernel.quantity == quantity]
        results = np.array([whole(kernel, kernel.values(x)) for kernel in same])
        middle = np.median(results, axis=0)
        errors = (abs(results - middle).max(axis=2) / abs(middle).max(axis=1)).max(axis=1)
        for kernel, error in zip(same, errors):
            key = (quantity, kernel.library.peer)
            worst[key] = max(worst.get(key, 0.0), error if np.isfinite(error) else np.inf)
    wrong = [f"{quantity}: {peer} is off by {e:.1e}" for (quantity, peer), e in worst.items() if e > TOLERANCE]
    if wrong:
        sys.exit(f"{arm.name}: no agreement to {TOLERANCE:.0e}, nothing timed:\n" + "\n".join(wrong))
    return worst


def whole(kernel, values):
    """Pinocchio leaves M in its upper triangle."""
    if (kernel.library.peer, kernel.quantity) != ("Pinocchio", "mass_matrix"):
        return values
    n = kernel.width // 3
    upper = np.triu(values.reshape(-1, n, n).transpose(0, 2, 1))
    return (upper + np.triu(upper, 1).transpose(0, 2, 1)).reshape(values.shape)


class Peer(ctypes.Structure):
    _fields_ = [("single", ctypes.c_void_p), ("returning", ctypes.c_void_p), ("batch", ctypes.c_void_p)]


def time_in_turns(kernels, arm, rounds, count=8 * BLOCK, seed=2):
    """Seconds a state, `rounds` times for every kernel, into `kernel.times`; quantity by quantity, kernels in turns."""
    timer = timer_library()
    x = inputs(arm, count, seed)
    in_blocks = np.concatenate([block.ravel() for block in blocks(x)])
    for quantity in QUANTITIES:
        same = [kernel for kernel in kernels if kernel.quantity == quantity]
        pointers = [Peer(**{kernel.kind: kernel.address}) for kernel in same]
        seconds, out = np.zeros((rounds, len(same))), np.zeros(BLOCK * same[0].size)
        timer.time_in_turns(
            (Peer * len(same))(*pointers), len(same), pointer(x), pointer(in_blocks), x.shape[1], count, BLOCK, rounds,
            pointer(out), pointer(seconds),
        )  # fmt: skip
        for kernel, times in zip(same, seconds.T):
            kernel.times = times


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def timer_library():
    path = BUILD / "timer.so"
    subprocess.run(["gcc", "-O2", "-shared", "-fPIC", "-o", path, HERE / "native/timer.c"], check=True)
    return ctypes.CDLL(str(path))
