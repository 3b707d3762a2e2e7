"""One arm: generated, compiled whole and quantity by quantity, proven, timed."""

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path

from . import crate, table
from .process import Cost, measured, output

WHOLE, NONE = "whole file", "no kernel"


@dataclass
class Build:
    """A compilation in one profile, and the stack that the result takes, kB."""

    cost: Cost
    stack: int | None = None


@dataclass
class Row:
    """A quantity of an arm; numbers that do not apply are absent."""

    joints: int
    quantity: str
    lines: int
    operations: int | None = None
    generate: Cost | None = None
    nanoseconds: float | None = None
    builds: dict[str, Build] = field(default_factory=dict)

    def faults(self) -> list[str]:
        return [f"{profile}: {build.cost.fault}" for profile, build in self.builds.items() if build.cost.fault]


def build_cli() -> Path:
    output(["cargo", "build", "--quiet", "--release", "--package", "ulna-cli"], cwd=crate.ROOT)
    return crate.ROOT / "target/release/ulna"


def arm(cli: Path, joints: int, options) -> list[Row]:
    path = crate.BUILD / f"{table.name(joints)}.toml"
    path.write_text(table.table(joints, options.seed))
    generated = path.with_suffix(".rs")
    cost = measured([cli, "generate", path, "--output", generated], crate.BUILD, options.limit)
    if cost.fault:
        sys.exit(f"{path}: {cost.fault}")
    code = generated.read_text()
    quantities = json.loads(output([cli, "cost", "--json", path]))["quantities"]
    operations = {method: counts["total"] for method, counts in quantities.items()}

    rows = [Row(joints, WHOLE, code.count("\n"), sum(operations.values()), generate=cost), Row(joints, NONE, 0)]
    rows += [Row(joints, method, length, operations[method]) for method, length in crate.lines(code).items()]
    for row in rows:
        for profile in options.profiles:
            compile_and_call(row, code, profile, options.limit)
    return rows


def compile_and_call(row: Row, code: str, profile: str, limit: float):
    part = code if row.quantity == WHOLE else crate.only(row.quantity, code)
    build = row.builds[profile] = Build(crate.compile_library(part, profile, limit))
    progress(row, profile, build.cost)
    if build.cost.fault or row.quantity == NONE:
        return
    if row.quantity == WHOLE:
        # Sizes that a debug build has no stack for are proven in release.
        if profile == "release":
            output([crate.program(profile), "prove"])
        return
    program = crate.program(profile)
    build.stack = crate.stack(program, row.quantity)
    if profile == "release":
        row.nanoseconds = float(output([program, "time", row.quantity]))


def progress(row: Row, profile: str, cost: Cost):
    result = cost.fault or f"{cost.seconds:.1f} s, {cost.megabytes:.0f} MB"
    print(f"{row.joints} joints, {row.quantity}, {profile}: {result}", file=sys.stderr, flush=True)
