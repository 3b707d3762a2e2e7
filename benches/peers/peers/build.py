"""From formulations and crates to shared libraries that all export  kernel(arm, quantity) -> function(x, out)."""

import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import casadi as ca

from . import formulations
from .arm import Arm
from .quantities import ONE_MORE, PAIRS, QUANTITIES

HERE = Path(__file__).resolve().parent.parent
ROOT = HERE.parent.parent
BUILD = ROOT / "target" / "peers"

# What a user of each language would write. "default" is what comes without asking for the machine at hand.
C_FLAGS = {"native": ["-O3", "-march=native"], "-O3": ["-O3"], "-O2": ["-O2"]}
RUST_FLAGS = {"native": "-C target-cpu=native", "default": ""}


@dataclass
class Library:
    peer: str
    flags: str
    path: Path
    symbol: str = "kernel"
    kind: str = "single"  # how its functions are called: native/timer.c
    operations: dict = field(default_factory=dict)  # quantity -> {"total", "sin_cos"}
    seconds: float = 0.0  # of processor time to compile


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


def everything(arm: Arm, table: Path):
    """Every library for one arm, and the quantities that ulna has: nothing else is built of the others."""
    listing, rust = rust_libraries(table)
    quantities = [name for name in QUANTITIES if name in listing["methods"]]
    x = formulations.Arguments(len(arm.joints))
    given = {
        "CasADi, CRBA": formulations.composites(arm, x),
        "CasADi, Newton-Euler": formulations.newton_euler(arm, x),
        "CasADi, our formulation": formulations.ours(arm, x, listing),
        "C of our programs": formulations.our_programs(arm, x, listing),
    }
    jobs = []
    for peer, ways in given.items():
        expressions = {name: formulations.cheapest(x, ways[name]) for name in quantities if name in ways}
        source, counts = casadi_source(arm, peer, x, expressions)
        jobs += [("gcc", peer, flags, source, counts) for flags in C_FLAGS]
    source = pinocchio_source(arm)
    jobs += [("g++", "Pinocchio", flags, source, {}) for flags in ("native", "-O3")]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        compiled = list(pool.map(lambda job: compiled_library(*job), jobs))
    for library in rust:
        library.operations = {
            name: {"total": len(program["steps"]), "sin_cos": 2 * len(program["angles"])}
            for name, program in listing["methods"].items()
        }
    return compiled + rust, quantities


def casadi_source(arm, peer, x, expressions):
    """One C file with a function for each quantity, and the lookup that every library exports."""
    n = len(arm.joints)
    generator = ca.CodeGenerator("casadi.c", {"with_header": False})
    functions = [formulations.function(name, x, expression) for name, expression in expressions.items()]
    for function in functions:
        generator.add(function)
    wrappers = "".join(
        f"""
static void run_{f.name()}(const double *x, double *out) {{
    const double *arg[{max(f.sz_arg(), 3)}] = {{x, x + {n}, x + {2 * n}}};
    double *res[{max(f.sz_res(), 1)}] = {{out}};
    {f.name()}(arg, res, 0, 0, 0);
}}
"""
        for f in functions
    )
    cases = "".join(f'    if (!strcmp(quantity, "{f.name()}")) return run_{f.name()};\n' for f in functions)
    lookup = f"""
#include <string.h>
void (*kernel(const char *arm, const char *quantity))(const double *, double *) {{
    (void)arm;
{cases}    return 0;
}}
"""
    source = generator.dump()
    if "w[" in source:
        sys.exit(f"{peer}: CasADi's code uses its work vector, which is not passed here")
    source += wrappers + lookup
    return source, {f.name(): formulations.operations(f) for f in functions}


def pinocchio_source(arm: Arm):
    def numbers(array):
        return "{" + ", ".join(repr(float(value)) for value in array) + "}"

    placements = [arm.base @ arm.joints[0].placement, *(j.placement for j in arm.joints[1:])]
    joints = ",\n".join(
        f"    {{{str(j.revolute).lower()}, {numbers(placement[:3].ravel())}, {j.mass!r}, {numbers(j.com)}, {numbers(j.inertia.ravel())},"
        f" {j.armature!r}, {j.viscous!r}, {j.coulomb!r}, {j.smoothing!r}}}"
        for j, placement in zip(arm.joints, placements)
    )
    header = f"""constexpr int N = {len(arm.joints)};
const struct {{ bool revolute; double placement[12], mass, com[3], inertia[9], armature, viscous, coulomb, smoothing; }} JOINTS[N] = {{
{joints}
}};
constexpr bool FRICTION = {str(arm.has_friction()).lower()};
const int TASK[] = {{{", ".join(map(str, arm.task))}}};
const double TOOL[12] = {numbers(arm.tool[:3].ravel())};
const double GRAVITY[3] = {numbers(arm.gravity)};
"""
    return header + (HERE / "native/pinocchio.cpp").read_text()


def compiled_library(compiler, peer, flags, source, operations):
    suffix, options = {"gcc": ("c", []), "g++": ("cpp", pinocchio_options())}[compiler]
    command = [compiler, *C_FLAGS[flags], "-shared", "-fPIC", *options]
    key = hashlib.sha256(json.dumps([source, [str(word) for word in command]]).encode()).hexdigest()[:16]
    path = BUILD / f"{key}.so"
    record = path.with_suffix(".seconds")
    if not record.exists():
        path.with_suffix(f".{suffix}").write_text(source)
        command += ["-o", path, path.with_suffix(f".{suffix}"), *(["-lm"] if suffix == "c" else [])]
        child = subprocess.Popen([str(word) for word in command])
        _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            sys.exit(" ".join(map(str, command)))
        record.write_text(str(usage.ru_utime + usage.ru_stime))
    return Library(peer, flags, path, operations=operations, seconds=float(record.read_text()))


def pinocchio_options():
    """Header-only, so that the flags reach all of it. CasADi's wheel carries Eigen's headers, of the version that Debian has too."""
    import pinocchio

    prefix = next(p for p in Path(pinocchio.__file__).parents if p.name == "cmeel.prefix")
    eigen = Path(ca.__file__).parent / "include/eigen3"
    return [
        "-std=c++17",
        "-w",
        "-DNDEBUG",
        "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
        "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
        "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
        f"-isystem{prefix / 'include'}",
        f"-isystem{eigen}",
    ]


def rust_libraries(table: Path):
    """Our programs as data, and our kernels under both sets of flags."""
    libraries = []
    for flags, rustflags in RUST_FLAGS.items():
        target = BUILD / f"rust-{flags}"
        # A crate with the arm in question, whichever it is.
        cargo = ["cargo", "build", "--release", "--package", "ulna-peers", "--features", f"ulna-generated/{table.stem}", "--target-dir", target]
        run(cargo, cwd=ROOT, env=os.environ | {"RUSTFLAGS": rustflags})
        path = target / "release/libulna_peers.so"
        libraries += [
            Library("ulna", flags, path, "kernel", "returning"),
            Library("ulna, batch", flags, path, "batch_kernel", "batch"),
            Library("ulna, generic path", flags, path, "generic_kernel", "returning"),
            Library(PAIRS, flags, path, "pairs_kernel", "returning"),
            Library(ONE_MORE, flags, path, "one_more_kernel", "returning"),
        ]
    listing = json.loads(run([BUILD / "rust-default/release/listing", table]))
    return listing, libraries
