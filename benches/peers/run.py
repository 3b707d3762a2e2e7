#!/usr/bin/env python3
"""ulna beside CasADi and Pinocchio: builds them all, compares their values, times them in turns, writes results.md."""

import argparse
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
VENV = HERE / ".venv"


def in_virtual_environment():
    """Runs this script again by the virtual environment's interpreter, which is made first."""
    wanted = (HERE / "requirements.txt").read_text()
    installed = VENV / "requirements.txt"
    if not installed.exists() or installed.read_text() != wanted:
        subprocess.run([sys.executable, "-m", "venv", "--clear", VENV], check=True)
        subprocess.run([VENV / "bin/pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
        installed.write_text(wanted)
    python = str(VENV / "bin/python")
    os.execv(python, [python, __file__, *sys.argv[1:]])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("arms", nargs="*", default=["ssrms", "oblique_6"], help="names of tables in arms/")
    parser.add_argument("--rounds", type=int, default=300, help="times each kernel passes over all inputs")
    parser.add_argument("--output", type=Path, default=HERE / "results.md")
    options = parser.parse_args()

    from peers import arm, build, measure, report

    build.BUILD.mkdir(parents=True, exist_ok=True)
    sections = []
    for name in options.arms:
        table = build.ROOT / "arms" / f"{name}.toml"
        model = arm.read(table)
        libraries = build.everything(model, table)
        kernels = measure.kernels(libraries, model)
        errors = measure.agreement(kernels, model)
        measure.time_in_turns(kernels, model, options.rounds)
        sections.append(report.section(model, libraries, kernels, errors))
    text = report.page(sections, options.rounds)
    options.output.write_text(text)
    print(text)


if __name__ == "__main__":
    main() if Path(sys.prefix) == VENV else in_virtual_environment()
