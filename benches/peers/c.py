#!/usr/bin/env python3
"""Every method as C, by gcc and by clang, beside the same method as Rust: times in turns, and instructions by callgrind; writes c.md.

    python3 benches/peers/c.py                     ssrms and oblique_6
    python3 benches/peers/c.py planar_2r --rounds 100 --output /tmp/c.md

Needs gcc, clang, valgrind and cargo, and no package of Python's.
"""

import argparse
import ctypes
import datetime
import hashlib
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = ROOT / "target/peers"
CALLS = 16  # as in native/count.c
COUNT = 256  # states that a pass goes over
COMPILERS = ["gcc", "clang"]
# The compilers' own rules of contraction: gcc fuses (but not with -std=c99), clang within an expression.
FLAGS = {"-O3 -march=native": ["-O3", "-march=native"], "-O2": ["-O2"]}
# What callgrind can run, and finds fused multiply-adds in as Rust does at run time.
COUNTED = ["-O2", "-march=x86-64-v3"]

PROTOTYPE = re.compile(r"^void (\w+)\(([^)]*)\);", re.MULTILINE)
PARAMETER = re.compile(r"(\w+)\[(\d+)\]")


@dataclass
class Method:
    name: str
    parameters: list  # names and lengths, the result last
    joints: int

    def argument(self, name):
        places = {"q": "x", "qd": f"x + {self.joints}", "qdd": f"x + {2 * self.joints}", "tau": f"x + {2 * self.joints}"}
        return places.get(name, "none" if name == "payload" else f"x + {3 * self.joints}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("arms", nargs="*", default=["ssrms", "oblique_6"], help="names of tables in arms/")
    parser.add_argument("--rounds", type=int, default=200)
    parser.add_argument("--ulna", type=Path, help="the program, if it has been built")
    parser.add_argument("--rust", type=Path, help="ulna's library with default flags, if it has been built")
    parser.add_argument("--output", type=Path, default=HERE / "c.md")
    options = parser.parse_args()
    ulna = options.ulna or program()
    sections = [section(arm, ulna, options.rust or rust(arm), options.rounds) for arm in options.arms]
    text = "\n\n".join([head(options.rounds), *sections]) + "\n"
    options.output.write_text(text)
    print(text)


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


def program():
    run(["cargo", "build", "--package", "ulna-cli"], cwd=ROOT)
    return ROOT / "target/debug/ulna"


def rust(arm):
    target = BUILD / "rust-default"
    cargo = ["cargo", "build", "--release", "--package", "ulna-peers", "--features", f"ulna-generated/{arm}", "--target-dir", target]
    run(cargo, cwd=ROOT, env=os.environ | {"RUSTFLAGS": ""})
    return target / "release/libulna_peers.so"


def source(arm, ulna):
    """The arm in C, with the lookup that every peer exports."""
    folder = BUILD / "c" / arm
    run([ulna, "generate", ROOT / f"arms/{arm}.toml", "--language", "c", "--precision", "double", "--output", folder])
    header = (folder / f"{arm}.h").read_text()
    joints = int(re.search(r": (\d+) joints, unrolled", header)[1])
    methods = []
    for name, parameters in PROTOTYPE.findall(header):
        if name != f"{arm}_payload":
            methods.append(Method(name.removeprefix(f"{arm}_"), PARAMETER.findall(parameters), joints))
    lines = [f'#include "{arm}.c"', "#include <string.h>", "static const double none[10] = { 0 };"]
    for method in methods:
        arguments = ", ".join([*(method.argument(name) for name, _ in method.parameters[:-1]), "out"])
        lines.append(f"static void run_{method.name}(double *out, const double *x) {{ (void)none; {arm}_{method.name}({arguments}); }}")
    lines.append("void (*kernel(const char *arm, const char *quantity))(double *, const double *) {\n    (void)arm;")
    lines += [f'    if (!strcmp(quantity, "{method.name}")) return run_{method.name};' for method in methods]
    path = folder / "kernels.c"
    path.write_text("\n".join([*lines, "    return 0;\n}\n"]))
    return path, methods


def compiled(path, compiler, flags):
    key = hashlib.sha256(repr([path.read_text(), path.with_name(f"{path.parent.name}.c").read_text(), compiler, flags]).encode())
    library = BUILD / f"{key.hexdigest()[:16]}.so"
    if not library.exists():
        run([compiler, *flags, "-shared", "-fPIC", path, "-o", library, "-lm"])
    return library


class Peer(ctypes.Structure):
    _fields_ = [("single", ctypes.c_void_p), ("returning", ctypes.c_void_p), ("batch", ctypes.c_void_p)]


def kernel(library, arm, name):
    find = ctypes.CDLL(str(library)).kernel
    find.argtypes, find.restype = [ctypes.c_char_p] * 2, ctypes.c_void_p
    return find(arm.encode(), name.encode())


def times(arm, method, libraries, rounds):
    """Nanoseconds of each library: the median over the rounds, in which all take turns."""
    timer = BUILD / "timer.so"
    if not timer.exists():
        run(["gcc", "-O2", "-shared", "-fPIC", "-o", timer, HERE / "native/timer.c"])
    width, random_one = 3 * method.joints + 6, random.Random(1)
    x = (ctypes.c_double * (width * COUNT))(*(random_one.uniform(-1, 1) for _ in range(width * COUNT)))
    peers = (Peer * len(libraries))(*(Peer(returning=kernel(library, arm, method.name)) for library in libraries))
    out = (ctypes.c_double * max(int(method.parameters[-1][1]), 16))()
    seconds = (ctypes.c_double * (rounds * len(libraries)))()
    in_turns = ctypes.CDLL(str(timer)).time_in_turns
    in_turns(peers, len(libraries), x, x, width, COUNT, 64, rounds, out, seconds)
    return [1e9 * statistics.median(seconds[i :: len(libraries)]) for i in range(len(libraries))]


def instructions(arm, methods, library):
    """Of a call of each method."""
    with tempfile.TemporaryDirectory() as folder:
        run(["gcc", "-O2", "-o", Path(folder, "count"), HERE / "native/count.c", "-ldl"])
        Path(folder, "kernels.so").symlink_to(Path(library).resolve())
        words = [word for method in methods for word in (arm, method.name)]
        valgrind = [run(["which", "valgrind"]).strip(), "--quiet", "--tool=callgrind", "--callgrind-out-file=out"]
        run([*valgrind, "./count", "./kernels.so", *words], cwd=folder, env={})
        texts = [Path(folder, f"out.{number}").read_text() for number in range(1, len(methods) + 1)]
    return [round(int(re.search(r"^(?:summary|totals): (\d+)", text, re.MULTILINE)[1]) / CALLS) for text in texts]


def section(arm, ulna, rust_library, rounds):
    path, methods = source(arm, ulna)
    columns = [(compiler, title) for title in FLAGS for compiler in COMPILERS]
    libraries = [rust_library, *(compiled(path, compiler, FLAGS[title]) for compiler, title in columns)]
    found = {method.name: times(arm, method, libraries, rounds) for method in methods}
    counted = [instructions(arm, methods, library) for library in [rust_library, *(compiled(path, compiler, COUNTED) for compiler in COMPILERS)]]
    titles = [f"{compiler} {title}" for compiler, title in columns]
    lines = [
        f"## {arm}\n",
        f"| | Rust, ns | {' | '.join(titles)} | Rust, instructions | gcc | clang |",
        f"|---|{'--:|' * (len(columns) + 4)}",
    ]
    for k, method in enumerate(methods):
        own, *others = found[method.name]
        cells = [f"{other:.0f} ({other / own:.2f}×)" for other in others]
        counts = [counted[0][k], *(f"{count[k]} ({count[k] / counted[0][k]:.2f}×)" for count in counted[1:])]
        lines.append(f"| {method.name} | {own:.0f} | {' | '.join(cells)} | {' | '.join(map(str, counts))} |")
    ratios = [statistics.geometric_mean(ns[i] / ns[0] for ns in found.values()) for i in range(1, len(libraries))]
    ratios_of = [statistics.geometric_mean(max(a, 1) / b for a, b in zip(count, counted[0])) for count in counted[1:]]
    means = [f"**{ratio:.2f}×**" for ratio in ratios]
    lines.append(f"| geometric mean | | {' | '.join(means)} | | {' | '.join(f'**{ratio:.2f}×**' for ratio in ratios_of)} |")
    return "\n".join(lines)


def head(rounds):
    cpu = next(line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name"))
    versions = [run([compiler, "--version"]).splitlines()[0] for compiler in ("rustc", *COMPILERS)]
    load = ", ".join(f"{average:.1f}" for average in os.getloadavg())
    return f"""# The same programs as Rust and as C

Written by `python3 benches/peers/c.py` on {datetime.date.today()}. {cpu.split(":")[1].strip()}; {"; ".join(versions)}; load average {load}.

Rust is the generated arm with default flags, which finds fused multiply-adds and lanes at run time and has sines and cosines of its own, all angles in one call;
C calls `sin` and `cos` of the C library one by one. Medians over {rounds} rounds in turns, a pass over {COUNT} random states each; instructions are those of
callgrind, C with `{" ".join(COUNTED)}`. Where other programs run beside it, instructions are the steadier figure."""


if __name__ == "__main__":
    main()
