"""The rows as growth.csv: what was measured before is kept until it is measured again."""

import csv
from pathlib import Path

PROFILES = ["dev", "release"]
WORDS = ["quantity", *(f"{profile}_fault" for profile in PROFILES)]
COLUMNS = ["joints", "quantity", "operations", "lines", "generate_s", "generate_MB", "call_ns"]
COLUMNS += [f"{profile}_{what}" for profile in PROFILES for what in ("s", "elapsed_s", "MB", "stack_kB", "fault")]


def read(path: Path) -> list[dict]:
    if not path.exists():
        return []
    with path.open(newline="") as file:
        records = [{key: text for key, text in record.items() if text} for record in csv.DictReader(file)]
    return [{key: text if key in WORDS else float(text) for key, text in record.items()} for record in records]


def write(rows: list[dict], path: Path):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: value if key in WORDS else shortened(value) for key, value in row.items()} for row in rows)


def shortened(number: float | None) -> str:
    """Two decimals below 100, none above: more is noise."""
    return "" if number is None else f"{number:.2f}".rstrip("0").rstrip(".") if number < 100 else f"{number:.0f}"
