"""One arm: generated, compiled whole and quantity by quantity, proven, timed."""

import json
import sys
from pathlib import Path

from . import crate, table
from .process import measured, output

WHOLE, NONE = "whole file", "no kernel"


def build_cli() -> Path:
    output(["cargo", "build", "--quiet", "--release", "--package", "ulna-cli"], cwd=crate.ROOT)
    return crate.ROOT / "target/release/ulna"


def arm(cli: Path, joints: int, options) -> list[dict]:
    """A row for each quantity; numbers that do not apply are absent."""
    path = crate.BUILD / f"{table.name(joints)}.toml"
    path.write_text(table.table(joints, options.seed))
    generated = path.with_suffix(".rs")
    cost = measured([cli, "generate", path, "--output", generated], crate.BUILD, options.limit)
    if cost.fault:
        sys.exit(f"{path}: {cost.fault}")
    code = generated.read_text()
    quantities = json.loads(output([cli, "cost", "--json", path]))["quantities"]
    operations = {method: counts["total"] for method, counts in quantities.items()}

    whole = {"quantity": WHOLE, "operations": sum(operations.values()), "lines": code.count("\n")}
    whole |= {"generate_s": cost.seconds, "generate_MB": cost.megabytes}
    rows = [whole, {"quantity": NONE}]
    for method, length in crate.lines(code).items():
        rows.append({"quantity": method, "operations": operations[method], "lines": length})
    for row in rows:
        row["joints"] = joints
        for profile in options.profiles:
            compile_and_call(row, code, profile, options.limit)
    return rows


def compile_and_call(row: dict, code: str, profile: str, limit: float):
    quantity = row["quantity"]
    cost = crate.compile_library(code if quantity == WHOLE else crate.only(quantity, code), profile, limit)
    row |= {f"{profile}_s": cost.seconds, f"{profile}_elapsed_s": cost.elapsed, f"{profile}_MB": cost.megabytes}
    progress = f"{row['joints']} joints, {quantity}, {profile}: {cost.fault or f'{cost.seconds:.1f} s, {cost.megabytes:.0f} MB'}"
    print(progress, file=sys.stderr, flush=True)
    if cost.fault:
        row[f"{profile}_fault"] = cost.fault.split("\n")[0]
    elif quantity == WHOLE:
        # Sizes that a debug build has no stack for are proven in release.
        if profile == "release":
            output([crate.program(profile), "prove"])
    elif quantity != NONE:
        program = crate.program(profile)
        row[f"{profile}_stack_kB"] = crate.stack(program, quantity)
        if profile == "release":
            row["call_ns"] = float(output([program, "time", quantity]))
