#!/usr/bin/env python3
"""Public robot descriptions through `ulna import`, `check`, `generate` and `verify`, beside Pinocchio on the descriptions themselves.

    python3 urdf/public/run.py                     everything; writes docs/urdf.md and target/public_urdfs/results.json
    python3 urdf/public/run.py --only panda ur5    descriptions whose wheel, file or options contain one of the words; prints the page
    python3 urdf/public/run.py --release           with the optimised program

Makes an environment with Pinocchio beside this file, downloads the wheels of wheels.txt into target/, and runs nothing of what is in them.
Exit code 1 if anything went wrong: a command broke off, a table that does not pass, a difference beyond 1e-10.
"""

import argparse
import dataclasses
import json
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD", help="descriptions that contain one of these words")
    parser.add_argument("--release", action="store_true", help="build with optimisations")
    parser.add_argument("--jobs", type=int, default=2, help="descriptions at a time")
    options = parser.parse_args()

    import pinocchio
    from robots import page, wheels
    from robots.program import ROOT, Programs
    from robots.trial import attempt

    programs = Programs(options.release)
    work = ROOT / "target" / "public_urdfs"
    folders = wheels.unpack(HERE / "wheels.txt", work)
    tables = work / "tables"
    tables.mkdir(exist_ok=True)

    def one(trial):
        done = attempt(programs, folders[trial.wheel], tables, trial)
        state = "ok" if done.passed else "refused" if done.was_refused else "WRONG"
        print(f"{state:8} {done.wheel}: {done.title}", file=sys.stderr, flush=True)
        return done

    wanted = [trial for trial in plan(folders) if any(word in f"{trial.wheel}: {trial.title}" for word in options.only)]
    with ThreadPoolExecutor(options.jobs) as pool:
        trials = list(pool.map(one, wanted))
    text = page.page(trials, wheels.versions(HERE / "wheels.txt"), pinocchio.__version__)
    if options.only == [""]:
        (ROOT / "docs" / "urdf.md").write_text(text)
        results = [{**dataclasses.asdict(trial), "passed": trial.passed} for trial in trials]
        (work / "results.json").write_text(json.dumps(results, indent=1) + "\n")
    else:
        print(text)
    sys.exit(any(trial.went_wrong for trial in trials))


def plan(folders):
    """Every file of every wheel as it is, and after it with the options that are listed for it."""
    from robots import wheels
    from robots.trial import Trial

    choices = tomllib.loads((HERE / "choices.toml").read_text())["choice"]
    trials = []
    for wheel, folder in folders.items():
        for file in wheels.descriptions(folder):
            trials.append(Trial(wheel, file, []))
            for choice in choices:
                if (choice["wheel"], choice["file"]) == (wheel, file):
                    trials.append(Trial(**choice))
    assert len([trial for trial in trials if trial.options]) == len(choices), "a choice for a file that is not there"
    return trials


if __name__ == "__main__":
    sys.path.append(str(HERE.parents[1] / "benches"))
    import virtual_environment

    virtual_environment.enter(HERE)
    main()
