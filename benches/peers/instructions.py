#!/usr/bin/env python3
"""Instructions that the generated kernels execute, default flags, counted by callgrind: into instructions.csv, or --check against it.

Steady where times are not. A change of compiler or C library moves them too: write the file anew then, and look at the diff.
Arms are those of arms/, quantities all methods of `Arm`. One that the file has no count for is named, and fails nothing.
"""

import argparse
import csv
import ctypes
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TARGET = ROOT / "target/peers/rust-default"
COUNTS = HERE / "instructions.csv"
CALLS = 16  # as in native/count.c
TOLERANCE = 0.01


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help=f"fail where a count rose by more than {TOLERANCE:.0%}")
    check = parser.parse_args().check
    counts = counted()
    if check:
        sys.exit(compared(counts))
    with COUNTS.open("w") as file:
        csv.writer(file, lineterminator="\n").writerows([["arm", "quantity", "instructions"], *counts])


def counted():
    """Rows of arm, quantity and instructions a call."""
    cargo = ["cargo", "build", "--quiet", "--release", "--package", "ulna-peers", "--features", "all-arms", "--target-dir", TARGET]
    subprocess.run(cargo, cwd=ROOT, check=True)
    library = TARGET / "release/libulna_peers.so"
    pairs = [(table.stem, quantity) for table in sorted((ROOT / "arms").glob("*.toml")) for quantity in methods(library)]
    with tempfile.TemporaryDirectory() as folder:
        driver = Path(folder, "count")
        subprocess.run(["gcc", "-O2", "-o", driver, HERE / "native/count.c", "-ldl"], check=True)
        Path(folder, "ulna.so").symlink_to(library)
        valgrind = [shutil.which("valgrind") or "valgrind", "--quiet", "--tool=callgrind", "--callgrind-out-file=out"]
        words = [word for pair in pairs for word in pair]
        # No environment and no paths: their lengths move the stack, and its alignment a few instructions.
        subprocess.run([*valgrind, "./count", "./ulna.so", *words], cwd=folder, env={}, check=True)
        rows = []
        for number, (arm, quantity) in enumerate(pairs, start=1):
            text = Path(folder, f"out.{number}").read_text()
            if f"Client Request: {quantity}" not in text:
                sys.exit(f"callgrind's file {number} is not that of {quantity}")
            total = int(re.search(r"^(?:summary|totals): (\d+)", text, re.MULTILINE)[1])
            rows.append((arm, quantity, round(total / CALLS)))
    return rows


def methods(library):
    """The names of all methods."""
    name = ctypes.CDLL(str(library)).quantity
    name.argtypes, name.restype = [ctypes.c_size_t], ctypes.c_char_p
    found = []
    while (next_one := name(len(found))) is not None:
        found.append(next_one.decode())
    return found


def compared(counts):
    """What differs from the file, printed; 1 if anything rose beyond the tolerance or is no longer there."""
    with COUNTS.open() as file:
        known = {(row["arm"], row["quantity"]): int(row["instructions"]) for row in csv.DictReader(file)}
    found = {(arm, quantity): count for arm, quantity, count in counts}
    bad = 0
    for key in sorted(known | found):
        before, after = known.get(key), found.get(key)
        if before == after:
            continue
        if before is None:
            print(f"{' '.join(key)}: {after}, not in {COUNTS.name} yet")
            continue
        rose = after is None or after > before * (1 + TOLERANCE)
        bad |= rose
        print(f"{' '.join(key)}: {before} -> {after}{'  <- look' if rose else ''}")
    return int(bad)


if __name__ == "__main__":
    main()
