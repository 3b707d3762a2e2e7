#!/usr/bin/env python3
"""What the C code of arms of ever more joints costs to compile: processor seconds and memory of gcc and clang, by the length of its functions.

    python3 benches/growth/c.py                                          all sizes and lengths; writes c.csv and c.md
    python3 benches/growth/c.py --joints 15 --lengths 500 --compilers gcc    these anew; c.csv keeps the others

The arms are those of run.py. `whole` is the file with all methods. `largest` is mass_matrix_and_derivatives alone.
Needs cargo, gcc and clang. Exit code 1 if something of 15 joints takes more than 1 GB.
"""

import argparse
import csv
import datetime
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = ["joints", "what", "length", "compiler", "seconds", "MB", "source_MB"]
LARGEST = "mass_matrix_and_derivatives"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    numbers = lambda text: [int(number) for number in text.split(",")]
    parser.add_argument("--joints", type=numbers, default="7,15,30")
    parser.add_argument("--lengths", type=numbers, default="500,2000,8000")
    parser.add_argument("--compilers", type=lambda text: text.split(","), default="gcc,clang")
    parser.add_argument("--what", type=lambda text: text.split(","), default="whole,largest")
    parser.add_argument("--limit", type=float, default=3600, help="seconds that a compilation may take")
    parser.add_argument("--ulna", type=Path, help="the program, if it has been built")
    options = parser.parse_args()

    from growth import crate, measure

    ulna = options.ulna.resolve() if options.ulna else measure.build_cli()
    crate.BUILD.mkdir(parents=True, exist_ok=True)
    for joints in options.joints:
        for what in options.what:
            for length in options.lengths:
                for row in measured(ulna, joints, what, length, options):
                    add(row)
    rows = read()
    (HERE / "c.md").write_text(page(rows))
    sys.exit(any(float(row["MB"]) > 1000 for row in rows if row["joints"] == "15"))


def measured(ulna, joints, what, length, options):
    from growth import crate, process, table

    path = crate.BUILD / f"{table.name(joints)}.toml"
    path.write_text(table.table(joints, 1))
    folder = crate.BUILD / f"c_{joints}_{what}_{length}"
    methods = [] if what == "whole" else ["--methods", LARGEST]
    command = [ulna, "generate", path, "--language", "c", "--function-length", str(length), *methods, "--output", folder]
    process.output(command)
    source = folder / f"{table.name(joints)}.c"
    for compiler in options.compilers:
        cost = process.measured([compiler, "-std=c99", "-O2", "-c", source.name, "-o", f"{compiler}.o"], folder, options.limit)
        if cost.fault:
            sys.exit(f"{joints} joints, {what}, {length}, {compiler}: {cost.fault}")
        numbers = [f"{cost.seconds:.1f}", f"{cost.megabytes:.0f}", f"{source.stat().st_size / 1e6:.1f}"]
        yield dict(zip(COLUMNS, [str(joints), what, str(length), compiler, *numbers]))


def read():
    path = HERE / "c.csv"
    return list(csv.DictReader(path.open())) if path.exists() else []


def add(row):
    """What was measured before is kept until it is measured again."""
    same = ["joints", "what", "length", "compiler"]
    rows = [old for old in read() if any(old[key] != row[key] for key in same)] + [row]
    rows.sort(key=lambda row: (int(row["joints"]), row["what"], int(row["length"]), row["compiler"]))
    with (HERE / "c.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def page(rows):
    lines = [
        "# To compile the C code of an arm\n",
        f"Written by `python3 benches/growth/c.py` on {datetime.date.today()}, from `c.csv`: `-std=c99 -O2 -c`, processor seconds (they drift with what else runs) and memory"
        " of the largest process. Arms of `growth/table.py`: nothing folds. `length` is that of `--function-length`; `whole` has all methods, "
        f"`largest` {LARGEST} alone.\n",
        "| joints | | length | source, MB | compiler | s | MB |",
        "|--:|---|--:|--:|---|--:|--:|",
    ]
    lines += [f"| {r['joints']} | {r['what']} | {r['length']} | {r['source_MB']} | {r['compiler']} | {r['seconds']} | {r['MB']} |" for r in rows]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.path.append(str(HERE.parent))
    import virtual_environment

    virtual_environment.enter(HERE)
    main()
