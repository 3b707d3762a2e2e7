"""docs/urdf.md."""

from robots.comparison import QUANTITIES
from robots.trial import SAMPLES, STATES, TOLERANCE

# So much of what is said of a description is shown.
LINES = 30


def page(trials, versions, pinocchio):
    good = [trial for trial in trials if trial.passed]
    wrong = [trial for trial in trials if trial.broke or (trial.imported and not trial.passed)]
    refused = [trial for trial in trials if not trial.imported and not trial.broke]
    parts = [introduction(trials, good, refused, wrong, versions, pinocchio)]
    if wrong:
        parts += ["## Wrong", *map(failure, wrong)]
    parts += ["## Imported", table(good), "## What was said of them", *said(good)]
    parts += ["## Refused", *said(refused)]
    return "\n\n".join(parts) + "\n"


def introduction(trials, good, refused, wrong, versions, pinocchio):
    worst = max((trial.worst() for trial in good), default=float("nan"))
    files = len({(trial.wheel, trial.file) for trial in trials})
    return f"""# Robot descriptions that others wrote

Written by `python3 urdf/public/run.py`, which downloads these wheels, unpacks their descriptions and lets every one of them go through
`ulna import`, `ulna check`, `ulna generate` and `ulna verify --samples {SAMPLES}`: {", ".join(versions)}.
None of them is in this repository. `urdf/public/choices.toml` lists the options where a description holds more than one chain; those files
are imported without options too.

{files} files in {len(trials)} trials: {len(good)} imported, {len(refused)} refused, {len(wrong)} gone wrong.
The largest difference to Pinocchio is {worst:.1e}.

The differences are to Pinocchio {pinocchio}, which reads the description itself: joints outside the chain locked at 0, the base link's frame as world,
gravity along its -z, `J` in world axes at the tip link's origin. Each is the largest over {STATES} random states and all entries, of the
generated program and of the textbook, divided by the largest entry of that quantity. They agree at the same `q` without signs or offsets, so `q` is
the description's; `tau` includes the friction of its `<dynamics>`. Limits, efforts, damping and friction in the table are the description's, too.
More than {TOLERANCE:.0e} would count as gone wrong."""


def table(trials):
    head = ["description", "options", "joints", "warnings", "notes", *QUANTITIES.values()]
    rows = [
        [
            f"{trial.wheel}: {trial.file}",
            " ".join(trial.options),
            trial.joints,
            count(trial, "warning"),
            count(trial, "note"),
            *(f"{trial.worst(quantity):.0e}" for quantity in QUANTITIES),
        ]
        for trial in trials
    ]
    lines = [head, ["---", "---", *["---:"] * (len(head) - 2)], *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def count(trial, word):
    """Of `ulna import` and `ulna check` together, those that both say once."""
    lines = {line for line in f"{trial.said}\n{trial.check_said}".splitlines() if line.startswith(word)}
    return len(lines)


def said(trials):
    """What `ulna import` said, the same words under one heading."""
    groups = {}
    for trial in trials:
        groups.setdefault(trial.said, []).append(trial)
    for words, alike in groups.items():
        if words:
            yield "\n".join(f"`{trial.wheel}: {trial.title}`" + (f": {trial.why}" if trial.why else "") + "  " for trial in alike)
            yield f"```text\n{shortened(words)}\n```"


def shortened(words):
    """A humanoid has dozens of chains, and each is listed."""
    lines = words.splitlines()
    if len(lines) <= LINES:
        return words
    return "\n".join([*lines[: LINES - 1], f"(and {len(lines) - LINES + 1} more lines)"])


def failure(trial):
    facts = {
        "import": trial.said if not trial.imported or trial.broke else "",
        "check": trial.checked,
        "generate": trial.generated,
        "verify": trial.verified,
        "table": trial.kept,
        "largest difference": f"{trial.worst():.1e}" if trial.differences else "",
    }
    lines = "\n".join(f"{name}: {fact}" for name, fact in facts.items() if fact not in ("", "ok"))
    return f"`{trial.wheel}: {trial.title}`\n\n```text\n{lines}\n```"
