"""docs/c.md."""

import datetime
import statistics
import subprocess
from collections import Counter

from .code import COMPILERS, CONTRACTIONS, MACHINE, PRECISIONS, WARNINGS


def page(checked, differences):
    arms = [one.arm for one in checked]
    warned = [text for one in checked for *_, text in one.compiled]
    looked = [found for one in checked for found in one.findings.values()]
    rules = sum((found for found in looked if found is not None), start=Counter())
    ran = [text for one in checked for text in one.memory.values()]
    lines = [
        "# The C code of every arm, checked\n",
        f"Written by `python3 codegen/checked/run.py` on {datetime.date.today()}, of {len(arms)} arms: {', '.join(arms)}.",
        f"{', '.join(version(program) for program in (*COMPILERS, 'cppcheck', 'valgrind'))}.\n",
        f"- `{' '.join(WARNINGS)} -O2`, in double and in single precision, `-ffp-contract=off` and `fast`: "
        f"**{sum(map(bool, warned))}** of {asked(warned, 'compilations')} warn.",
        f"- cppcheck with warnings, style, performance, portability and the MISRA add-on, CasADi's interface included: **{rules.total()} findings** in"
        f" {asked(looked, 'files')}" + (f" ({', '.join(f'{rule}: {count}' for rule, count in sorted(rules.items()))})." if rules else "."),
        "  This is not a claim of compliance: the add-on knows part of the rules.",
        f"- valgrind, every function on arrays as long as its prototype says: **{sum(map(bool, ran))}** of {asked(ran, 'programs')}"
        " read or write what they should not, use what was not written, or leak.\n",
    ]
    return "\n".join(lines + (beside_rust(differences) if differences else [])) + "\n"


def asked(said, what):
    """How many, and how many have not been asked yet."""
    unasked = said.count(None)
    return f"{len(said) - unasked} {what}" + (f" ({unasked} more not run yet)" if unasked else "")


def beside_rust(differences):
    compared = ", ".join(dict.fromkeys(one.arm for one in differences))
    return [
        "## C beside Rust\n",
        f"The largest difference between a result in C and Rust's in double precision, over 100 random states of each of {compared}, in units of the last place"
        " (2⁻⁵² in double, 2⁻²³ in single precision) of the largest entry of the part of the result; the arm where it is. Rust fuses products and sums where it"
        f" finds that in a formula; C leaves that to the compiler (`{' '.join(MACHINE)}`). Sines are the C library's here and ulna's own there."
        " `median` is that of the worst arm's states. Where a matrix is nearly singular, any two orders of rounding differ by its condition number.\n",
        table(differences, "double"),
        *unexplained(differences),
        "\n### In single precision\n",
        "Without states where a task counts as singular in single precision, whose results are 0.\n",
        table(differences, "float"),
    ]


def unexplained(differences):
    """What exceeds twice the error that the header states for the method."""
    of = [one for one in differences if not one.explained]
    names = sorted({f"{one.method} of {one.arm} in {one.precision} ({one.ulp:,.0f} units, stated {one.bound:,.0f})" for one in of})
    return [f"\nMore than twice the error that a header states: {', '.join(names) or 'none'}."]


def table(differences, precision):
    columns = [(compiler, contraction) for compiler in COMPILERS for contraction in CONTRACTIONS]
    titles = "".join(f" {compiler}, {contraction} |" for compiler, contraction in columns)
    lines = [f"| |{titles} median | arm |", f"|---|{'--:|' * (len(columns) + 1)}---|"]
    for method in dict.fromkeys(one.method for one in differences):
        of = [one for one in differences if one.method == method and one.precision == precision]
        cells = [max((one for one in of if (one.compiler, one.contraction) == column), key=lambda one: one.ulp) for column in columns]
        worst = max(cells, key=lambda one: one.ulp)
        numbers = "".join(f" {short(one.ulp)} |" for one in cells)
        lines.append(f"| {method} |{numbers} {short(worst.median)} | {worst.arm} |")
    usual = statistics.median(one.median for one in differences if one.precision == precision)
    return "\n".join(lines) + f"\n\nThe median over all arms, methods, compilers and states is {usual:.1f} units."


def short(number):
    return f"{number:.1f}" if number < 10 else f"{number:,.0f}"


def version(program):
    text = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    return text
