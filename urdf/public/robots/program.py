"""The program `ulna` and the example `evaluate`, as a user runs them."""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
# A description that takes longer is reported as one that hangs.
SECONDS = 1800


@dataclass
class Run:
    """What a command said."""

    code: int
    stdout: str
    stderr: str

    @property
    def passed(self):
        return self.code == 0

    @property
    def broke(self):
        """Neither done nor refused: a panic, a signal, no end."""
        return self.code not in (0, 1) or "panicked at" in self.stderr

    def count(self, word):
        return sum(line.startswith(word) for line in self.stderr.splitlines())


class Programs:
    def __init__(self, release: bool):
        target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / ("release" if release else "debug")
        build = ["cargo", "build", "--quiet", *(["--release"] if release else [])]
        subprocess.run([*build, "-p", "ulna-cli"], cwd=ROOT, check=True)
        subprocess.run([*build, "-p", "ulna-codegen", "--example", "evaluate"], cwd=ROOT, check=True)
        self.program, self.evaluator = target / "ulna", target / "examples" / "evaluate"

    def ulna(self, *arguments, folder: Path):
        return run([self.program, *arguments], folder)

    def evaluate(self, table: Path, states):
        """`states` are rows q, qd, qdd; what comes back is a list of the values of each road, one for each state."""
        lines = "".join(json.dumps(dict(zip(("q", "qd", "qdd"), map(list, state)))) + "\n" for state in states)
        result = run([self.evaluator, table], table.parent, lines)
        if not result.passed:
            raise RuntimeError(result.stderr)
        return [json.loads(line) for line in result.stdout.splitlines()]


def run(command, folder, text=None):
    environment = {**os.environ, "NO_COLOR": "1"}
    try:
        done = subprocess.run(command, cwd=folder, env=environment, input=text, capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return Run(124, "", f"no end within {SECONDS} s")
    return Run(done.returncode, done.stdout, done.stderr)
