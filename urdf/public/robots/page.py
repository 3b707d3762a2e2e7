"""docs/urdf.md."""

import re
from collections import Counter

from robots.comparison import QUANTITIES
from robots.trial import SAMPLES, STATES, TOLERANCE

# So much of what is said of a description is shown.
LINES = 40
# Every import says these two.
ALWAYS = ("note: the task, ", "note: a URDF says nothing of gravity")


def page(trials, versions, pinocchio):
    good = [trial for trial in trials if trial.passed]
    wrong = [trial for trial in trials if trial.went_wrong]
    refused = [trial for trial in trials if trial.was_refused]
    chosen = {(trial.wheel, trial.file) for trial in trials if trial.options}
    # Of what only waits for a choice, and nobody makes one here, the first line will do.
    brief = [trial for trial in refused if waits(trial) and (trial.wheel, trial.file) not in chosen]
    parts = [introduction(trials, good, refused, wrong, versions, pinocchio)]
    if wrong:
        parts += ["## Wrong", *map(failure, wrong)]
    parts += ["## Imported", table(good)]
    parts += ["## Refused", reasons(refused)]
    parts += ["## Refused, in full", *said(trial for trial in refused if trial not in brief)]
    parts += ["## Refused until a chain is chosen", listed(brief)]
    parts += ["## What was said of those imported", FOOTNOTE, *said(good)]
    return "\n\n".join(parts) + "\n"


FOOTNOTE = """By `ulna import`; of what `ulna check` adds, the first lines. Two notes that each of them has are left out: which rows of J the task has,
and that gravity is assumed."""


def introduction(trials, good, refused, wrong, versions, pinocchio):
    worst = max((trial.worst() for trial in good), default=float("nan"))
    files = len({(trial.wheel, trial.file) for trial in trials})
    went = f"{len(wrong)} went wrong" if wrong else "none went wrong"
    return f"""# Robot descriptions that others wrote

Written by `python3 urdf/public/run.py`, which downloads these wheels, unpacks their descriptions and lets every one of them go through
`ulna import`, `ulna check`, `ulna generate` and `ulna verify --samples {SAMPLES}`: {", ".join(versions)}.
None of them is in this repository. `urdf/public/choices.toml` lists the options where a description holds more than one chain, or asks for a decision;
those files are imported without options too.

{files} files, {len(trials)} imports: {len(good)} gave an arm that passes everything, {len(refused)} were refused, {went}.
The largest difference to Pinocchio is {worst:.1e}.

The differences are to Pinocchio {pinocchio}, which reads the description itself: joints outside the chain locked at 0, the base link's frame as world,
gravity along its -z, `J` in world axes at the tip link's origin. Each is the largest over {STATES} random states and all entries, of the
generated program and of the textbook, divided by the largest entry of that quantity. They agree at the same `q` without signs or offsets, so `q` is
the description's; `tau` includes the friction of its `<dynamics>`. Limits, efforts, damping and friction in the table are the description's, too.
More than {TOLERANCE:.0e} would count as gone wrong. Most differences above 1e-15 are liberties that `ulna import` takes on purpose: an angle within 1e-11 of a
quarter turn is one, a number that ends in 1e-13 of rounding does not."""


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
    return markdown(head, rows, ["---", "---", *["---:"] * (len(head) - 2)])


def reasons(trials):
    """Every error of every refusal, by its words without the names and numbers in it."""
    errors = Counter()
    for trial in trials:
        words = [line.removeprefix("error: ") for line in trial.said.splitlines() if line.startswith("error: ")]
        errors.update({re.sub(r"\b\d+\b", "N", re.sub("`[^`]*`", "`...`", line)) for line in words})
    return markdown(["error", "imports"], errors.most_common(), ["---", "---:"])


def listed(trials):
    rows = [[f"{trial.wheel}: {trial.file}", trial.said.splitlines()[0].removeprefix("error: ")] for trial in trials]
    return markdown(["description", "the first line of the error, after which the chains are listed"], rows, ["---", "---"])


def markdown(head, rows, rule):
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in [head, rule, *rows])


def count(trial, word):
    """Of `ulna import` and `ulna check` together, those that both say once."""
    lines = [line for line in f"{trial.said}\n{trial.check_said}".splitlines() if line.startswith(word)]
    return len(set(lines))


def waits(trial):
    """Whether nothing is wrong but that the description has several chains."""
    errors = [line for line in trial.said.splitlines() if line.startswith("error")]
    return len(errors) == 1 and errors[0].endswith("which one is the arm?")


def said(trials):
    """What was said, the same words under one heading."""
    groups = {}
    for trial in trials:
        lines = [line for line in trial.said.splitlines() if not line.startswith(ALWAYS)]
        added = [line for line in trial.check_said.splitlines() if line.startswith("warning: ") and line not in lines]
        words = "\n".join([*lines, *(["", *(f"check: {line}" for line in added)] if added else [])])
        groups.setdefault(words.strip(), []).append(trial)
    for words, alike in groups.items():
        if words:
            names = [f"`{trial.wheel}: {trial.title}`" + (f": {trial.why}" if trial.why else "") for trial in alike]
            yield "\n".join(f"- {name}" for name in names)
            yield f"```text\n{shortened(words)}\n```"


def shortened(words):
    """A humanoid has dozens of chains, and each is listed."""
    lines = words.splitlines()
    if len(lines) <= LINES:
        return words
    return "\n".join([*lines[: LINES - 1], f"(and {len(lines) - LINES + 1} more lines)"])


def failure(trial):
    facts = {
        "import": trial.said if not trial.imported else "",
        "check": trial.checked,
        "generate": trial.generated,
        "verify": trial.verified,
        "table": trial.kept,
        "largest difference": f"{trial.worst():.1e}" if trial.differences else "",
    }
    lines = "\n".join(f"{name}: {fact}" for name, fact in facts.items() if fact not in ("", "ok"))
    return f"`{trial.wheel}: {trial.title}`\n\n```text\n{lines}\n```"
