"""Agreement first, then times in turns."""

import ctypes
import subprocess
import sys

import numpy as np

from .arm import Arm
from .build import BUILD, HERE, Library
from .quantities import QUANTITIES

TOLERANCE = 1e-9

# Other ways of Pinocchio's to the same quantity; the fastest one is reported.
VARIANTS = {
    "mass_matrix": ["local"],
    "geometric_jacobian": ["joints"],
    "forward_dynamics": ["local"],
    "inverse_dynamics_derivatives": ["rows"],
    "forward_dynamics_derivatives": ["rows"],
}

SINGLE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
BATCH = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_long, ctypes.c_void_p)
# States in a call of a batch kernel.
BLOCK = 64


class Kernel:
    """One quantity of one library."""

    def __init__(self, library: Library, arm: Arm, quantity: str, variant: str):
        self.library, self.quantity, self.variant = library, quantity, variant
        self.width, self.size = 3 * len(arm.joints), QUANTITIES[quantity].size(len(arm.joints))
        find = getattr(ctypes.CDLL(str(library.path)), library.symbol)
        find.argtypes, find.restype = [ctypes.c_char_p] * 2, ctypes.c_void_p
        self.address = find(arm.name.encode(), f"{quantity}/{variant}".rstrip("/").encode())
        self.kind = library.kind
        self.times = np.array([])

    def values(self, x):
        """The results for every row of x; not a number where nothing was written."""
        out = np.full((len(x), self.size), np.nan)
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


def kernels(libraries, arm, quantities):
    every = (
        Kernel(library, arm, quantity, variant)
        for library in libraries
        for quantity in quantities
        for variant in ["", *VARIANTS.get(quantity, [])]
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
    for quantity, same in by_quantity(kernels):
        results = np.array([whole(kernel, kernel.values(x)) for kernel in same])
        middle = np.median(results, axis=0)
        largest = abs(middle).max(axis=1)
        largest[largest == 0] = 1  # where all is 0, as potential energy without gravity
        errors = (abs(results - middle).max(axis=2) / largest).max(axis=1)
        for kernel, error in zip(same, errors):
            key = (quantity, kernel.library.peer)
            worst[key] = max(worst.get(key, 0.0), error if np.isfinite(error) else np.inf)
    wrong = [f"{quantity}: {peer} is off by {e:.1e}" for (quantity, peer), e in worst.items() if e > TOLERANCE]
    if wrong:
        sys.exit(f"{arm.name}: no agreement to {TOLERANCE:.0e}, nothing timed:\n" + "\n".join(wrong))
    return worst


def by_quantity(kernels):
    """Each quantity with its kernels."""
    names = dict.fromkeys(kernel.quantity for kernel in kernels)
    return [(name, [kernel for kernel in kernels if kernel.quantity == name]) for name in names]


# Of a link's ten, in our order: Pinocchio has I as xx, xy, yy, xz, yz, zz.
PARAMETERS = [0, 1, 2, 3, 4, 5, 7, 6, 8, 9]


def whole(kernel, values):
    """As the others have it: Pinocchio leaves M and M⁻¹ in their upper triangles, some matrices by rows, parameters in another order."""
    if kernel.library.peer != "Pinocchio":
        return values
    n, name = kernel.width // 3, f"{kernel.quantity}/{kernel.variant}"
    if kernel.quantity == "regressor":
        return values.reshape(-1, n, 10, n)[:, :, PARAMETERS].reshape(values.shape)
    matrices = values.reshape(len(values), -1, n, n) if kernel.size % (n * n) == 0 else None
    if kernel.variant == "rows" or name == "inverse_mass_matrix/":
        matrices = matrices.transpose(0, 1, 3, 2)
    elif kernel.quantity != "mass_matrix":
        return values
    if kernel.quantity in ("mass_matrix", "inverse_mass_matrix"):
        # The last two axes are columns and rows.
        lower = np.tril(matrices)
        matrices = lower + np.tril(lower, -1).transpose(0, 1, 3, 2)
    return matrices.reshape(values.shape)


class Peer(ctypes.Structure):
    _fields_ = [("single", ctypes.c_void_p), ("returning", ctypes.c_void_p), ("batch", ctypes.c_void_p)]


def time_in_turns(kernels, arm, rounds, count=8 * BLOCK, seed=2):
    """Seconds a state, `rounds` times for every kernel, into `kernel.times`; quantity by quantity, kernels in turns."""
    timer = timer_library()
    x = inputs(arm, count, seed)
    in_blocks = np.concatenate([block.ravel() for block in blocks(x)])
    for _, same in by_quantity(kernels):
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
