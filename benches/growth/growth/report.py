"""The rows as results.md and growth.csv."""

import datetime
import os
import platform
from math import log

from .measure import NONE, WHOLE
from .process import output
from .rows import PROFILES


def page(rows: list[dict], options) -> str:
    load = " ".join(f"{average:.1f}" for average in os.getloadavg())
    sizes = ", ".join(str(size) for size in options.joints)
    parts = [
        "# How generated code grows with the number of joints\n",
        f"Written by `python3 benches/growth/run.py` on {datetime.date.today()} (seed {options.seed}); "
        "`README.md` says what is measured and how.\n",
        f"- {processor()}, {os.cpu_count()} cores, {platform.system()} {platform.release()}; "
        f"load average after the last sizes ({sizes} joints): {load}\n"
        f"- {output(['rustc', '--version']).strip()}, cargo's profiles as they are, no flags\n",
        "![Growth](growth.svg)\n",
        section("Operations", rows, "operations", "{:,.0f}"),
        section("Emitted lines", rows, "lines", "{:,.0f}"),
        section("A call in the release profile, ns", rows, "call_ns", "{:,.0f}"),
        section("To generate the file: seconds", rows, "generate_s", "{:.2f}"),
        section("To generate the file: MB", rows, "generate_MB", "{:,.0f}"),
    ]
    for profile in PROFILES:
        at = f"in the {profile} profile"
        parts += [
            section(f"To compile {at}: seconds of processors", rows, f"{profile}_s", "{:,.1f}"),
            section(f"To compile {at}: MB", rows, f"{profile}_MB", "{:,.0f}"),
            section(f"A call {at}: kB of stack", rows, f"{profile}_stack_kB", "{:,.0f}"),
        ]
    return "\n".join(parts)


def section(title: str, rows: list[dict], column: str, form: str) -> str:
    """A line for each quantity, a column for each size, and the exponent of growth between the last two."""
    sizes = sorted({row["joints"] for row in rows})
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    fault = f"{column.split('_')[0]}_fault"
    values = {(row["quantity"], row["joints"]): row.get(fault) or row.get(column) for row in rows}
    lines = [["", *(f"{size:.0f} joints" for size in sizes), "n^"]]
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
