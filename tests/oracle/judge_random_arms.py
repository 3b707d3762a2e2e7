"""The random arms of tests/random_arms against exact numbers.

Reads a file that the Rust test has written, one arm a line (table, q, results, textbook), computes w_D and its gradient
anew (exact_arm.py) and prints, for the generated programs and for the textbook path: the largest errors, how many
configurations have an error of each decade, apart for well and ill conditioned Jacobians, and the worst configurations.
Errors are relative to the larger of w_D and the gradient's largest entry. Where the program takes w_D for 0 and the exact
one is not, the error is 1. Configurations that are singular to the rounding of J, most of them because the task's rows
depend on each other everywhere, are counted apart: 0 is right there, and so is what a computation in doubles makes of it.

    python3 -m venv .venv && .venv/bin/pip install python-flint==0.9.0 numpy==2.4.6
    ULNA_RANDOM_ARMS=1000 ULNA_RANDOM_ARMS_RECORD=/tmp/arms.jsonl cargo test --release --test random_arms programs
    .venv/bin/python tests/oracle/judge_random_arms.py /tmp/arms.jsonl [--limit N] [--worst N] [--tables N]
"""

import argparse
import collections
import json
import math
import tomllib

from exact_arm import Arm

ILL_CONDITIONED = 1e4
# About the reciprocal of what the textbook path takes for 0: 16 N units of rounding.
SINGULAR = 1e13
ROADS = ("results", "textbook")
Case = collections.namedtuple("Case", "error w_error condition index q w gradient given exact_zero")


def judged(w, gradient, given, condition):
    """The errors of the gradient and of w_D."""
    if given["w"] is None or any(x is None for x in given["gradient"]):
        return math.inf, math.inf  # NaN or infinite
    if given["w"] == 0.0 and (w is None or condition > SINGULAR):
        return 0.0, 0.0
    if w is None:
        return 1.0, 1.0
    scale = max(abs(float(x.mid())) for x in (w, *gradient))
    differences = [abs(float((exact - x).mid())) for exact, x in zip(gradient, given["gradient"])]
    return max(differences) / scale, abs(float((w - given["w"]).mid())) / float(w.mid())


def read(path, limit):
    with open(path) as lines:
        for number, line in enumerate(lines):
            if limit is not None and number >= limit:
                return
            yield json.loads(line)


def decade(error):
    if error == 0.0:
        return -17
    return 99 if math.isinf(error) else max(-17, min(1, math.ceil(math.log10(error))))


def singular(case):
    return case.exact_zero or not case.condition <= SINGULAR


def table(cases):
    """How many errors are below each power of ten, and above that before it."""
    groups = {"cond J < 1e4": [], "cond J > 1e4": [], "singular": []}
    for case in cases:
        ill = "cond J > 1e4" if case.condition >= ILL_CONDITIONED else "cond J < 1e4"
        groups["singular" if singular(case) else ill].append(case)
    print(f"{'error of the gradient up to':28}" + "".join(f"{name:>14}" for name in groups))
    counts = {name: collections.Counter(decade(case.error) for case in group) for name, group in groups.items()}
    for power in sorted(set().union(*counts.values())):
        label = {99: "no number", 1: "more"}.get(power, f"1e{power}")
        print(f"{label:28}" + "".join(f"{count[power]:14}" for count in counts.values()))
    for what, key in (("largest, gradient", "error"), ("largest, w_D", "w_error")):
        cells = [max((getattr(case, key) for case in group), default=0.0) for group in groups.values()]
        print(f"{what:28}" + "".join(f"{cell:14.1e}" for cell in cells))


def worst(cases, count):
    print(f"\n{'arm':>6} {'gradient':>9} {'w_D':>9} {'cond J':>9}  q, exact w_D and gradient, w_D and gradient given")
    for case in cases[:count]:
        exact = "0" if case.exact_zero else f"{case.w:.6e} {[float(f'{x:.3e}') for x in case.gradient]}"
        given = case.given
        print(
            f"{case.index:6} {case.error:9.1e} {case.w_error:9.1e} {case.condition:9.0e}  "
            f"{case.q}\n{'':36}{exact}\n{'':36}{given['w']} {given['gradient']}"
        )


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("file")
    arguments.add_argument("--limit", type=int, help="arms to read")
    arguments.add_argument("--worst", type=int, default=20, help="configurations to print")
    arguments.add_argument("--tables", type=int, default=3, help="tables of the worst arms to print")
    arguments = arguments.parse_args()

    cases = {road: [] for road in ROADS}
    tables = {}
    without = 0
    for line in read(arguments.file, arguments.limit):
        if not line["results"]:
            without += 1  # the generator failed
            continue
        tables[line["index"]] = line["table"]
        arm = Arm(tomllib.loads(line["table"]))
        for number, q in enumerate(line["q"]):
            w, gradient = arm.manipulability(q)
            condition = arm.condition(q)
            plain = (0.0, None) if w is None else (float(w.mid()), [float(x.mid()) for x in gradient])
            for road in ROADS:
                given = line[road][number]
                errors = judged(w, gradient, given, condition)
                cases[road].append(Case(*errors, condition, line["index"], q, *plain, given, w is None))

    print(f"{len(tables)} arms, {len(cases['results'])} configurations; {without} arms without results")
    for road in ROADS:
        print(f"\n==== {'generated programs' if road == 'results' else 'textbook'}\n")
        table(cases[road])
    regular = [case for case in cases["results"] if not singular(case) or math.isinf(case.error)]
    regular.sort(key=lambda case: -case.error)
    worst(regular, arguments.worst)
    shown = dict.fromkeys(case.index for case in regular)
    for index in list(shown)[: arguments.tables]:
        print(f"\n==== arm {index}\n\n{tables[index]}")


if __name__ == "__main__":
    main()
