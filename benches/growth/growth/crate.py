"""A crate outside the workspace, as a user would have it, that holds one arm: all of its kernels, one, or none."""

import re
import shutil
from pathlib import Path

from .process import Cost, measured, output

ROOT = Path(__file__).resolve().parents[3]
BUILD = ROOT / "target" / "growth"
CRATE = BUILD / "crate"
FOLDERS = {"dev": "debug", "release": "release"}

MANIFEST = f"""\
[package]
name = "grown"
edition = "2024"

[workspace]

[dependencies]
ulna = {{ path = "{ROOT}" }}
ulna-growth = {{ path = "{ROOT}/benches/growth/rust" }}
"""
MAIN = """\
fn main() -> std::process::ExitCode {{
    ulna_growth::run(&grown::{arm}, &grown::{arm}::CHAIN)
}}
"""
# A kernel as it is printed: signature, name, body, end.
KERNEL = re.compile(r"(    fn (\w+)_kernel<[^{]*\{\n)(.*?\n)(    \}\n)", re.DOTALL)
# Powers of two, kB.
STACKS = [2**k for k in range(5, 18)]


def prepare():
    """An empty crate over built dependencies."""
    (CRATE / "src").mkdir(parents=True, exist_ok=True)
    (CRATE / "Cargo.toml").write_text(MANIFEST)
    shutil.copy(ROOT / "Cargo.lock", CRATE)
    (CRATE / "src/lib.rs").write_text("")
    (CRATE / "src/main.rs").write_text("fn main() {}")
    for profile in FOLDERS:
        output(["cargo", "build", "--quiet", "--profile", profile], cwd=CRATE)


def lines(code: str) -> dict[str, int]:
    """How long each kernel is."""
    return {kernel[2]: kernel[0].count("\n") for kernel in KERNEL.finditer(code)}


def only(method: str, code: str) -> str:
    """The code without all other kernels."""
    return KERNEL.sub(lambda kernel: kernel[0] if kernel[2] == method else f"{kernel[1]}unreachable!(){kernel[4]}", code)


def compile_library(code: str, profile: str, limit: float) -> Cost:
    """What it takes to build the crate's library, dependencies not counted, from nothing."""
    shutil.rmtree(CRATE / "target" / FOLDERS[profile] / "incremental", ignore_errors=True)
    (CRATE / "src/lib.rs").write_text(code)
    arm = re.search(r"pub struct (\w+);", code)[1]
    (CRATE / "src/main.rs").write_text(MAIN.format(arm=arm))
    return measured(["cargo", "build", "--quiet", "--lib", "--profile", profile], CRATE, limit)


def program(profile: str) -> Path:
    """The crate's program over the library that was compiled last."""
    output(["cargo", "build", "--quiet", "--profile", profile], cwd=CRATE)
    return CRATE / "target" / FOLDERS[profile] / "grown"


def stack(program: Path, method: str) -> int | None:
    """The smallest stack, kB, on which a call of the method lives."""
    return next((kib for kib in STACKS if output([program, "stack", method, str(kib)], may_fail=True) is not None), None)
