#!/usr/bin/env python3
"""Arms of ever more joints: what it costs to generate, to compile and to call each quantity."""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    numbers = lambda text: sorted(int(number) for number in text.split(","))
    parser.add_argument("--joints", type=numbers, default="2,4,7,10,15,20,30", help="sizes, with commas between")
    parser.add_argument("--profiles", type=lambda text: text.split(","), default="dev,release")
    parser.add_argument("--seed", type=int, default=1, help="of the tables")
    parser.add_argument("--limit", type=float, default=900, help="seconds that a compilation may take")
    parser.add_argument("--output", type=Path, default=HERE, help="the folder to write into")
    options = parser.parse_args()

    from growth import crate, measure, plot, report, rows

    options.output.mkdir(parents=True, exist_ok=True)
    table = options.output / "growth.csv"
    known = rows.read(table)
    cli = measure.build_cli()
    crate.prepare()
    for joints in options.joints:
        new = measure.arm(cli, joints, options)
        known = sorted([row for row in known if row["joints"] != joints] + new, key=lambda row: row["joints"])
        # After every size: a run that is cut short can be carried on.
        rows.write(known, table)
    known = rows.read(table)
    text = report.page(known, options)
    (options.output / "results.md").write_text(text)
    plot.draw(known, options.output)
    print(text)
    faults = [
        f"{row['quantity']}, {row['joints']:.0f} joints, {profile}: {row[f'{profile}_fault']}"
        for row in known
        for profile in rows.PROFILES
        if f"{profile}_fault" in row
    ]
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    sys.path.append(str(HERE.parent))
    import virtual_environment

    virtual_environment.enter(HERE)
    main()
