#!/usr/bin/env python3
"""ulna beside CasADi and Pinocchio: builds them all, compares their values, times them in turns, writes results.md."""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


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
        libraries, quantities = build.everything(model, table)
        kernels = measure.kernels(libraries, model, quantities)
        errors = measure.agreement(kernels, model)
        measure.time_in_turns(kernels, model, options.rounds)
        sections.append(report.section(model, libraries, kernels, errors, quantities))
    text = report.page(sections, options.rounds)
    options.output.write_text(text)
    print(text)


if __name__ == "__main__":
    sys.path.append(str(HERE.parent))
    import virtual_environment

    virtual_environment.enter(HERE)
    main()
