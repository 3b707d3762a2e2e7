"""The rows as results.md and growth.csv."""

import csv
import datetime
import os
import platform
from math import log

from .measure import NONE, WHOLE, Row
from .process import output


def write(rows: list[Row], options):
    (options.output / "results.md").write_text(page(rows, options))
    with (options.output / "growth.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        head = [f"{profile}_{what}" for profile in options.profiles for what in ("s", "elapsed_s", "MB", "stack_kB", "fault")]
        writer.writerow(["joints", "quantity", "operations", "lines", "generate_s", "generate_MB", "call_ns", *head])
        writer.writerows(record(row, options.profiles) for row in rows)


def record(row: Row, profiles: list[str]) -> list:
    generate = [round(row.generate.seconds, 2), round(row.generate.megabytes)] if row.generate else [None, None]
    time = row.nanoseconds and round(row.nanoseconds, 1)
    cells = [row.joints, row.quantity, row.operations, row.lines, *generate, time]
    for profile in profiles:
        build = row.builds[profile]
        cost = build.cost
        cells += [round(cost.seconds, 2), round(cost.elapsed, 2), round(cost.megabytes), build.stack, cost.fault.split("\n")[0]]
    return cells


def page(rows: list[Row], options) -> str:
    load = " ".join(f"{average:.1f}" for average in os.getloadavg())
    parts = [
        "# How generated code grows with the number of joints\n",
        f"Written by `python3 benches/growth/run.py` on {datetime.date.today()} (seed {options.seed}); "
        "`README.md` says what is measured and how.\n",
        f"- {processor()}, {os.cpu_count()} cores, {platform.system()} {platform.release()}; load average at the end: {load}\n"
        f"- {output(['rustc', '--version']).strip()}, cargo's profiles as they are, no flags\n",
        "![Growth](growth.svg)\n",
        section("Operations", rows, lambda row: row.operations, "{:,.0f}"),
        section("Emitted lines", rows, lambda row: row.lines or None, "{:,.0f}"),
        section("A call in the release profile, ns", rows, lambda row: row.nanoseconds, "{:,.0f}"),
        section("To generate the file: seconds", rows, lambda row: row.generate and row.generate.seconds, "{:.2f}"),
        section("To generate the file: MB", rows, lambda row: row.generate and row.generate.megabytes, "{:,.0f}"),
    ]
    for profile in options.profiles:
        at = f"in the {profile} profile"
        parts += [
            section(f"To compile {at}: seconds of processors", rows, lambda row: seconds(row, profile), "{:,.1f}"),
            section(f"To compile {at}: MB", rows, lambda row: megabytes(row, profile), "{:,.0f}"),
            section(f"A call {at}: kB of stack", rows, lambda row: row.builds[profile].stack, "{:,.0f}"),
        ]
    return "\n".join(parts)


def seconds(row: Row, profile: str) -> float | str:
    cost = row.builds[profile].cost
    return cost.fault.split("\n")[0] or cost.seconds


def megabytes(row: Row, profile: str) -> float | None:
    cost = row.builds[profile].cost
    return None if cost.fault else cost.megabytes


def section(title: str, rows: list[Row], value, form: str) -> str:
    """A line for each quantity, a column for each size, and the exponent of growth between the last two."""
    sizes = sorted({row.joints for row in rows})
    quantities = list(dict.fromkeys(row.quantity for row in rows))
    values = {(row.quantity, row.joints): value(row) for row in rows}
    lines = [["", *(f"{size} joints" for size in sizes), "n^"]]
    for quantity in sorted(quantities, key=lambda quantity: (quantity == WHOLE, quantity != NONE)):
        cells = [values.get((quantity, size)) for size in sizes]
        if any(cell is not None for cell in cells):
            lines.append([quantity, *(text(cell, form) for cell in cells), exponent(sizes, cells)])
    lines.insert(1, ["---", *["---:"] * (len(sizes) + 1)])
    return f"## {title}\n\n" + "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def text(value, form: str) -> str:
    return "–" if value is None else value if isinstance(value, str) else form.format(value)


def exponent(sizes: list[int], values: list) -> str:
    if len(sizes) < 2 or not all(isinstance(value, (int, float)) and value > 0 for value in values[-2:]):
        return ""
    return f"{log(values[-1] / values[-2]) / log(sizes[-1] / sizes[-2]):.1f}"


def processor() -> str:
    with open("/proc/cpuinfo") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return names[0] if names else platform.machine()
