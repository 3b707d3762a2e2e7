"""The tables, as Markdown."""

import datetime
import importlib.metadata
import os
import platform
import subprocess
from pathlib import Path

import numpy as np

from .arm import ROWS
from .quantities import ONE_MORE, PAIRS, QUANTITIES

CASADI = ["CasADi, CRBA", "CasADi, Newton-Euler", "CasADi, our formulation", "C of our programs"]
PEERS = ["ulna", "ulna, batch", *CASADI, "Pinocchio", "ulna, generic path"]
LOOPS = [PAIRS, ONE_MORE]


def section(arm, libraries, kernels, errors, quantities):
    seconds = {}  # (quantity, peer, flags) -> median; the fastest one where there are several ways
    for k in kernels:
        flags = "native" if k.library.flags == "native" else "default"
        key = (k.quantity, k.library.peer, flags)
        seconds[key] = min(seconds.get(key, np.inf), float(np.median(k.times)))
    rows = ", ".join(ROWS[i] for i in arm.task)
    missing = [name for name in QUANTITIES if name not in quantities]
    parts = [
        f"## {arm.name}: {len(arm.joints)} joints, task {rows}",
        *([f"Left out, because `Arm` has no such method: {', '.join(missing)}."] if missing else []),
        "Native flags, ns a call (× ulna's):",
        times(seconds, "native", quantities),
        *loops(seconds, "native", quantities),
        "Default flags, ns a call (× ulna's); the faster of -O3 and -O2:",
        times(seconds, "default", quantities),
        *loops(seconds, "default", quantities),
        *expectations(seconds, quantities),
        "Operations (and sines and cosines) after common subexpressions:",
        operations(libraries, quantities),
        "Seconds of processor time to compile all quantities, kB of code:",
        compilation(libraries),
        "Largest difference from the median of all peers, relative to the largest entry:",
        differences(errors, quantities),
    ]
    return "\n\n".join(parts)


def times(seconds, flags, quantities, peers=PEERS):
    def cell(quantity, peer):
        own, other = seconds[quantity, "ulna", flags], seconds.get((quantity, peer, flags))
        if other is None:
            return "–"
        return f"{1e9 * other:.0f}" if peer == "ulna" else f"{1e9 * other:.0f} ({other / own:.2f}×)"

    return table(peers, {QUANTITIES[q].title: [cell(q, peer) for peer in peers] for q in quantities})


def loops(seconds, flags, quantities):
    """What has loops over our own methods for peers, in a table of its own."""
    looped = [q for q in quantities if any((q, peer, flags) in seconds for peer in LOOPS)]
    return [times(seconds, flags, looped, ["ulna", *LOOPS])] if looped else []


def expectations(seconds, quantities):
    """Where a peer takes less than the times ulna's that are expected of it; nothing if no peer does."""
    below = []
    for quantity in quantities:
        for peer, least in QUANTITIES[quantity].least.items():
            for flags in ("native", "default"):
                ratio = seconds[quantity, peer, flags] / seconds[quantity, "ulna", flags]
                if ratio < least:
                    below.append([QUANTITIES[quantity].title, peer, flags, f"{ratio:.2f}×", f"{least}×"])
    if not below:
        return ["All peers take as many times ulna's as `peers/quantities.py` expects, on both sets of flags."]
    lines = [["", "peer", "flags", "× ulna's", "expected"], ["---"] * 3 + ["---:"] * 2, *below]
    return ["Below what `peers/quantities.py` expects:", "\n".join(f"| {' | '.join(line)} |" for line in lines)]


def operations(libraries, quantities):
    def cell(quantity, peer):
        counts = next(library.operations.get(quantity) for library in libraries if library.peer == peer)
        return f"{counts['total']} ({counts['sin_cos']})" if counts else "–"

    peers = ["ulna", *CASADI[:3]]
    return table(peers, {QUANTITIES[q].title: [cell(q, peer) for peer in peers] for q in quantities})


def compilation(libraries):
    rows = {}
    for library in libraries:
        if library.seconds:
            size = library.path.stat().st_size / 1000
            rows[f"{library.peer}, {library.flags}"] = [f"{library.seconds:.1f}", f"{size:.0f}"]
    return table(["s", "kB"], rows)


def differences(errors, quantities):
    def cell(quantity, peer):
        error = errors.get((quantity, peer))
        return "–" if error is None else f"{error:.0e}"

    peers = PEERS + [peer for peer in LOOPS if any(peer == other for _, other in errors)]
    return table(peers, {QUANTITIES[q].title: [cell(q, peer) for peer in peers] for q in quantities})


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
