"""From a table to a shared library that casadi.external reads, and the textbook as CasADi's own expressions."""

import subprocess
import sys
from pathlib import Path

import casadi as ca

from peers import arm, derived, textbook

ROOT = Path(__file__).resolve().parents[3]
BUILD = ROOT / "target/casadi"


def run(command):
    done = subprocess.run([str(word) for word in command], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")


def library(name: str) -> Path:
    """The arm's C code, compiled."""
    table, path = ROOT / f"arms/{name}.toml", BUILD / f"lib{name}.so"
    BUILD.mkdir(parents=True, exist_ok=True)
    methods = "inverse_dynamics,inverse_dynamics_derivatives,mass_matrix,forward_dynamics,forward_dynamics_derivatives"
    generate = ["cargo", "run", "--quiet", "--package", "ulna-cli", "--", "generate", table, "--language", "c", "--abi", "casadi"]
    run([*generate, "--methods", methods, "--output", BUILD])
    run(["cc", "-O2", "-shared", "-fPIC", BUILD / f"{name}.c", BUILD / f"{name}_casadi.c", "-o", path, "-lm"])
    return path


def external(name: str, path: Path):
    """Inverse and forward dynamics of the library. Its Jacobians are exact; of these CasADi takes differences where it wants second derivatives."""
    options = {"jacobian_options": {"enable_fd": True}}
    return [ca.external(f"{name}_casadi_{method}", str(path), options) for method in ("inverse_dynamics", "forward_dynamics")]


def own(name: str):
    """The same as a CasADi user writes it: Newton and Euler's torques, M by composite rigid bodies, solved by its LDL factors."""
    model = arm.read(ROOT / f"arms/{name}.toml")
    n = len(model.joints)
    q, qd, last = (ca.SX.sym(letter, n) for letter in ("q", "qd", "x"))
    torques = textbook.inverse_dynamics(model, q, qd, last)
    bias = textbook.inverse_dynamics(model, q, qd, ca.SX(n, 1))
    accelerations = derived.solve(textbook.mass_matrix_of_composites(model, q), last - bias)
    names = (("inverse", torques), ("forward", accelerations))
    return [ca.Function(f"{way}_dynamics", [q, qd, last], [ca.densify(value)], {"cse": True}) for way, value in names]
