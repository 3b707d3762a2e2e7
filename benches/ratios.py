#!/usr/bin/env python3
"""Prints what criterion measured as Markdown: generated beside generic, and the control cycle's shares.

Run `cargo bench --bench arm --bench cycle` first. Medians of one run; of the machine's other work they say nothing.
"""

import json
import sys
from pathlib import Path

CRITERION = Path(__file__).resolve().parent.parent / "target" / "criterion"


def median(benchmark: Path) -> float | None:
    """Nanoseconds a call, or None if it was not run."""
    try:
        estimates = json.loads((benchmark / "new" / "estimates.json").read_text())
    except FileNotFoundError:
        return None
    return estimates["median"]["point_estimate"]


def groups() -> dict[tuple[str, str], dict[str, float]]:
    """Medians by (arm, method) and benchmark. Criterion's folders are named arm_method: the benchmark itself knows better."""
    found: dict[tuple[str, str], dict[str, float]] = {}
    for about in sorted(CRITERION.glob("*/*/new/benchmark.json")):
        benchmark = json.loads(about.read_text())
        time = median(about.parent.parent)
        if time is not None:
            arm, method = benchmark["group_id"].split("/")
            found.setdefault((arm, method), {})[benchmark["function_id"]] = time
    return found


def table(titles: list[str], rows: list[list[str]]) -> None:
    print("| " + " | ".join(titles) + " |")
    print("|---" + "|---:" * (len(titles) - 1) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def main() -> None:
    measured = groups()
    arms = sorted({arm for arm, _ in measured})
    methods = sorted({method for _, method in measured} - {"cycle"})
    if not measured:
        sys.exit(f"{CRITERION} has no measurements: run `cargo bench --bench arm --bench cycle` first")

    print("Generated code, ns a call (times the generic path's speed):\n")
    rows = []
    for method in methods:
        cells = []
        for arm in arms:
            times = measured.get((arm, method), {})
            if {"generated", "generic"} <= times.keys():
                fast, slow = times["generated"], times["generic"]
                cells.append(f"{fast:.0f} ({slow / fast:.1f}×)")
            else:
                cells.append("")
        rows.append([f"`{method}`", *cells])
    table(["method", *arms], rows)

    for arm in arms:
        times = measured.get((arm, "cycle"), {})
        part = times.pop("generated_part", None)
        if part is None:
            continue
        print(f"One control cycle on `{arm}`, and the share of it that is generated code ({part:.0f} ns):\n")
        rows = [
            [name.replace("_", " "), f"{time:.0f} ns", "" if name == "generic" else f"{100 * part / time:.0f} %"]
            for name, time in times.items()
        ]
        table(["cycle", "time", "generated"], rows)


if __name__ == "__main__":
    main()
