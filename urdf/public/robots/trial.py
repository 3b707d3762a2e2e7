"""One description, one choice of options: import, check, generate, verify, and the comparison with Pinocchio."""

import re
import shlex
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from robots import comparison
from robots.reference import Reference, number

STATES = 50
SAMPLES = 20


@dataclass
class Trial:
    """What a description gave."""

    wheel: str
    file: str
    options: list
    why: str = ""
    broke: bool = False
    """A command neither did its work nor refused it in its own words."""
    imported: bool = False
    said: str = ""
    """By `ulna import`, on stderr."""
    joints: int = 0
    base: str = ""
    tip: str = ""
    checked: str = ""
    """`ok`, or what `ulna check` said; its warnings are in `check_said`."""
    check_said: str = ""
    generated: str = ""
    verified: str = ""
    differences: dict = field(default_factory=dict)
    """Of each road, of each quantity."""
    kept: str = ""
    """`ok`, or what of limits, efforts and friction differs between the table and the description."""

    @property
    def title(self):
        return f"{self.file} {shlex.join(self.options)}".rstrip()

    @property
    def passed(self):
        """Everything that follows an import did what it should."""
        done = [self.checked, self.generated, self.verified, self.kept]
        return self.imported and not self.broke and all(word == "ok" for word in done) and self.worst() <= TOLERANCE

    @property
    def was_refused(self):
        return not self.imported and not self.broke

    @property
    def went_wrong(self):
        return self.broke or (self.imported and not self.passed)

    def worst(self, quantity=None):
        found = [
            value
            for differences in self.differences.values()
            for name, value in differences.items()
            if quantity in (None, name)
        ]
        return max(found, default=float("inf"))


TOLERANCE = 1e-10


def attempt(programs, folder: Path, tables: Path, trial: Trial):
    """Fills in what `trial` leaves open. `folder` is where the wheel's descriptions are, `tables` where tables go."""
    imported = programs.ulna("import", trial.file, *trial.options, folder=folder)
    trial.imported, trial.broke, trial.said = imported.passed, imported.broke, imported.stderr.strip()
    if not imported.passed:
        if imported.stdout:
            trial.broke, trial.said = True, trial.said + "\n(and yet there is something on stdout)"
        return trial
    name = re.sub(r"[^A-Za-z0-9]+", "_", trial.title).strip("_").lower()
    table = tables / f"{name}.toml"
    table.write_text(imported.stdout)
    follow(programs, table, trial)
    try:
        compare(programs, folder, table, trial)
    except Exception as error:  # Whatever it is, it belongs into the table beside the other robots.
        trial.broke, trial.kept = True, f"{type(error).__name__}: {error}"
    return trial


def follow(programs, table: Path, trial: Trial):
    checked = programs.ulna("check", table.name, folder=table.parent)
    trial.checked, trial.check_said = verdict(checked), checked.stderr.strip()
    generated = programs.ulna("generate", table.name, folder=table.parent)
    trial.generated = verdict(generated)
    table.with_suffix(".rs").write_text(generated.stdout)
    verified = programs.ulna("verify", table.name, "--samples", str(SAMPLES), folder=table.parent)
    trial.verified = verdict(verified)
    table.with_suffix(".verify.txt").write_text(verified.stdout + verified.stderr)
    trial.broke |= any(run.broke for run in (checked, generated, verified))


def verdict(run):
    return "ok" if run.passed else (run.stderr.strip().splitlines() or [f"exit code {run.code}"])[-1]


def compare(programs, folder: Path, path: Path, trial: Trial):
    text = path.read_text()
    table = tomllib.loads(text)
    trial.joints = len(table["joint"])
    trial.base, trial.tip = ends(text, trial.options)
    dropped = [link for option, link in zip(trial.options, trial.options[1:]) if option == "--drop"]
    reference = Reference((folder / trial.file).read_bytes(), trial.base, trial.tip, dropped)
    states = reference.states(STATES)
    ours = programs.evaluate(path, states)
    theirs = [reference.values(*state) for state in states]
    trial.differences = {
        road: comparison.differences([values[road] for values in ours], theirs) for road in comparison.ROADS
    }
    trial.kept = "; ".join(lost(table, reference.joints)) or "ok"


def ends(text, options):
    """Base and tip of the chain: the table's first comments name them."""
    world, tool = (re.search(rf"^# .*{what}: the frame of the link `(.+?)`", text, re.MULTILINE) for what in ("World", "Tool"))
    given = dict(zip(options[::2], options[1::2]))
    for option, found in (("--base", world), ("--tip", tool)):
        if given.get(option, found[1]) != found[1]:
            raise ValueError(f"{option} is {given[option]}, the table's is {found[1]}")
    return world[1], tool[1]


def lost(table, joints):
    """What the table says otherwise than the description does."""
    if len(table["joint"]) != len(joints):
        yield f"{len(table['joint'])} joints, {len(joints)} in the description"
    unit = 3.141592653589793 / 180.0 if table["angle_unit"] == "deg" else 1.0
    for row, joint in zip(table["joint"], joints):
        turns = row.get("kind", "revolute") == "revolute"
        if row["name"] != re.sub("[^A-Za-z0-9_]+", "_", joint.get("name")):
            yield f"{joint.get('name')} has become {row['name']}"
        if turns != (joint.get("type") != "prismatic"):
            yield f"{row['name']} is {joint.get('type')}"
        scale = unit if turns else 1.0
        limits, friction = row.get("limits", {}), row.get("friction", {})
        bounded = joint.get("type") != "continuous"
        pairs = {
            "lower": (limits.get("lower"), number(joint, "limit", "lower") if bounded else None, scale),
            "upper": (limits.get("upper"), number(joint, "limit", "upper") if bounded else None, scale),
            "velocity": (limits.get("velocity"), number(joint, "limit", "velocity"), scale),
            "effort": (row.get("rated_torque"), number(joint, "limit", "effort"), 1.0),
            "damping": (friction.get("viscous"), number(joint, "dynamics", "damping"), 1.0),
            "friction": (friction.get("coulomb"), number(joint, "dynamics", "friction"), 1.0),
        }
        for word, (ours, theirs, scale) in pairs.items():
            ours = None if ours is None else ours * scale
            # What is 0 says as much as what is not there: no effort is known, there is no friction.
            if (ours or theirs) and not near(ours, theirs):
                yield f"{row['name']}: {word} {theirs} has become {ours}"


def near(ours, theirs):
    return ours is not None and theirs is not None and abs(ours - theirs) <= 1e-12 * max(1.0, abs(theirs))
