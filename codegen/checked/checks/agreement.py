"""Results of C beside those of Rust, in units of the last place of the largest entry."""

import ctypes
import itertools
import random
from dataclasses import dataclass

from .code import BUILD, COMPILERS, CONTRACTIONS, PRECISIONS, Files, prototypes

EPSILON = {"double": 2.0**-52, "float": 2.0**-23}
NUMBER = {"double": ctypes.c_double, "float": ctypes.c_float}
STATES = 100
# A sum that may come near 0: its error is that of its terms.
CANCELS = "potential_energy"
ARGUMENTS = {"q": 0, "qd": 1, "qdd": 2, "tau": 2, "wrench": 3}


@dataclass
class Difference:
    arm: str
    method: str
    precision: str
    compiler: str
    contraction: str
    ulp: float  # the worst of all states
    median: float
    bound: float  # what the errors that the header tells of both add up to, in the same units

    @property
    def explained(self):
        return self.ulp <= self.bound or self.method == CANCELS


def is_compiled(arm):
    folders = [Files(arm, precision, BUILD / arm / precision) for precision in PRECISIONS]
    return all(files.library(*way).exists() for files in folders for way in itertools.product(COMPILERS, CONTRACTIONS))


def differences(arm, rust):
    library = ctypes.CDLL(str(rust))
    library.kernel.restype, library.kernel.argtypes = ctypes.c_void_p, [ctypes.c_char_p] * 2
    found = []
    for precision in PRECISIONS:
        files = Files(arm, precision, BUILD / arm / precision)
        functions, errors = prototypes(files), stated_errors(files)
        for compiler in COMPILERS:
            for contraction in CONTRACTIONS:
                compiled = ctypes.CDLL(str(files.library(compiler, contraction)))
                for name, parameters in functions.items():
                    method = name.removeprefix(f"{arm}_")
                    kernel = library.kernel(arm.encode(), method.encode())
                    if not kernel:
                        continue  # the payload's function is no method
                    ulps = sorted(worst(getattr(compiled, name), kernel, method, parameters, precision))
                    scale = EPSILON["double"] / EPSILON[precision]
                    bound = 2 * errors[method] / EPSILON["double"] * (1 if scale == 1 else 2)
                    found.append(Difference(arm, method, precision, compiler, contraction, ulps[-1], ulps[len(ulps) // 2], bound))
    return found


def stated_errors(files):
    """Of each method, relative to the largest entry, in double precision."""
    lines = (line.split() for line in (files.folder / f"{files.arm}.h").read_text().split("*/")[0].splitlines())
    return {words[1]: float(words[-1]) for words in lines if len(words) == 11 and words[0] == "*" and words[2].isdigit()}


def worst(function, kernel, method, parameters, precision):
    """For each state the largest difference in the part of the result where it is largest."""
    generator, number = random.Random(1), NUMBER[precision]
    joints = next((length for name, length in parameters if name != "wrench" and name in ARGUMENTS))
    length = parameters[-1][1]
    call = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(kernel)
    for _ in range(STATES):
        # Arguments that single precision has as well.
        state = [ctypes.c_float(generator.uniform(-1, 1) * (3 if i < joints else 1)).value for i in range(3 * joints + 6)]
        expected, got = (ctypes.c_double * length)(), (number * length)()
        call(expected, (ctypes.c_double * len(state))(*state))
        arguments = []
        for name, size in parameters[:-1]:
            start = joints * ARGUMENTS.get(name, 0)
            values = state[start : start + size] if name in ARGUMENTS else [0.0] * size
            arguments.append((number * size)(*values))
        function(*arguments, got)
        places = parts(method, joints, length)
        if precision == "float":
            # Nearer to 0 than single precision tells apart, a task counts as singular: all that it has no value for is 0 then.
            places = [(a, b) for a, b in places if any(got[a:b])]
        yield max((ulps(got[a:b], expected[a:b], EPSILON[precision]) for a, b in places), default=0.0)


def ulps(got, expected, epsilon):
    largest = max(map(abs, expected))
    off = max(abs(a - b) for a, b in zip(got, expected))
    return off / (largest * epsilon) if largest else (0.0 if off == 0 else float("inf"))


def parts(method, n, length):
    """Where the parts of a result begin and end: errors are relative to the largest entry of a part, a gradient's to its function's value if that is larger."""
    sizes = {
        "forward_kinematics": [9, 3],
        "inverse_dynamics_derivatives": [n * n] * 2,
        "forward_dynamics_derivatives": [n * n] * 3,
        "mass_matrix_and_derivatives": [n * n, n**3],
        "jacobian_and_gradient": [6 * n, 1 + n],
    }.get(method, [length])
    ends = [sum(sizes[: i + 1]) for i in range(len(sizes))]
    return list(zip([0, *ends], ends))
