"""The tables, as Markdown."""

import datetime
import importlib.metadata
import os
import platform
import subprocess
from pathlib import Path

import numpy as np

from .arm import ROWS
from .quantities import QUANTITIES

TITLES = {
    "geometric_jacobian": "J, six rows",
    "mass_matrix": "M",
    "mass_matrix_derivatives": "all ∂M/∂q_i",
    "dynamic_manipulability_gradient": "w_D and ∇w_D",
    "inverse_dynamics": "inverse dynamics",
    "forward_dynamics": "forward dynamics",
}
CASADI = ["CasADi, CRBA", "CasADi, Newton-Euler", "CasADi, our formulation", "C of our programs"]
PEERS = ["ulna", "ulna, batch", *CASADI, "Pinocchio", "ulna, generic path"]


def section(arm, libraries, kernels, errors):
    seconds = {}  # (quantity, peer, flags) -> median; the faster one where there are several ways
    for k in kernels:
        flags = "native" if k.library.flags == "native" else "default"
        key = (k.quantity, k.library.peer, flags)
        seconds[key] = min(seconds.get(key, np.inf), float(np.median(k.times)))
    rows = ", ".join(ROWS[i] for i in arm.task)
    return "\n\n".join(
        [
            f"## {arm.name}: {len(arm.joints)} joints, task {rows}",
            "Native flags, ns a call (× ulna's):",
            times(seconds, "native"),
            "Default flags, ns a call (× ulna's); the faster of -O3 and -O2:",
            times(seconds, "default"),
            "Operations (and sines and cosines) after common subexpressions:",
            operations(libraries),
            "Seconds of processor time to compile all quantities, kB of code:",
            compilation(libraries),
            "Largest difference from the median of all peers, relative to the largest entry:",
            differences(errors),
        ]
    )


def times(seconds, flags):
    def cell(quantity, peer):
        own, other = seconds[quantity, "ulna", flags], seconds.get((quantity, peer, flags))
        if other is None:
            return "–"
        return f"{1e9 * other:.0f}" if peer == "ulna" else f"{1e9 * other:.0f} ({other / own:.2f}×)"

    return table(PEERS, {TITLES[q]: [cell(q, peer) for peer in PEERS] for q in QUANTITIES})


def operations(libraries):
    def cell(quantity, peer):
        counts = next(library.operations[quantity] for library in libraries if library.peer == peer)
        return f"{counts['total']} ({counts['sin_cos']})"

    peers = ["ulna", *CASADI[:3]]
    return table(peers, {TITLES[q]: [cell(q, peer) for peer in peers] for q in QUANTITIES})


def compilation(libraries):
    rows = {}
    for library in libraries:
        if library.seconds:
            size = library.path.stat().st_size / 1000
            rows[f"{library.peer}, {library.flags}"] = [f"{library.seconds:.1f}", f"{size:.0f}"]
    return table(["s", "kB"], rows)


def differences(errors):
    def cell(quantity, peer):
        error = errors.get((quantity, peer))
        return "–" if error is None else f"{error:.0e}"

    return table(PEERS, {TITLES[q]: [cell(q, peer) for peer in PEERS] for q in QUANTITIES})


def table(columns, rows):
    lines = [["", *columns], ["---"] + ["---:"] * len(columns), *([title, *cells] for title, cells in rows.items())]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def page(sections, rounds):
    def version(*command):
        return subprocess.run(command, capture_output=True, text=True).stdout.splitlines()[0]

    packages = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("casadi", "pin"))
    cpu = next(line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name"))
    head = f"""# ulna beside its peers

Written by `python3 benches/peers/run.py` on {datetime.date.today()}. Medians over {rounds} rounds in turns, one process; `README.md` says what is compared and how.

- {cpu.split(":")[1].strip()}, {os.cpu_count()} cores, {platform.system()} {platform.release()}
- {version("rustc", "--version")}: native `-C target-cpu=native`, default none
- {version("gcc", "--version")}: native `-O3 -march=native`, default `-O3` and `-O2`
- {packages}, Python {platform.python_version()}"""
    return "\n\n".join([head, *sections]) + "\n"
