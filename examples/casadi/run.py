#!/usr/bin/env python3
"""An arm's C code in CasADi: optimal control with the functions that casadi.external reads, beside the same with CasADi's own expressions.

    python3 examples/casadi/run.py             solves all problems both ways; writes docs/casadi.md
    python3 examples/casadi/run.py planar_2r   those of one arm; prints the page

Makes a virtual environment of requirements.txt beside this file. Needs cargo and a C compiler. Exit code 1 if an optimum differs.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("arms", nargs="*", help="planar_2r, ssrms; both if none is named")
    options = parser.parse_args()

    # The textbook in CasADi's expressions, as the benches have it.
    sys.path.append(str(ROOT / "benches/peers"))
    from swing import compare, page

    done = [compare.arm(name) for name in options.arms or compare.TASKS]
    text = page.page(done)
    if not options.arms:
        (ROOT / "docs/casadi.md").write_text(text)
    print(text)
    sys.exit(any(not pair.agrees for one in done for pair in one.pairs))


if __name__ == "__main__":
    sys.path.append(str(ROOT / "benches"))
    import virtual_environment

    virtual_environment.enter(HERE)
    main()
