#!/usr/bin/env python3
"""What compilers, cppcheck, valgrind and Rust say of the C code of every arm in arms/.

    python3 codegen/checked/run.py             all arms; writes docs/c.md
    python3 codegen/checked/run.py planar_2r   that one; prints the page

What is said of the same files once is not asked for again (target/checked_c), so that a run can be carried on.

Needs cargo, gcc, clang, cppcheck with its MISRA add-on, and valgrind, and no package of Python's. Half an hour of processor time.
Exit code 1 for any warning, finding or error, and where C and Rust differ by more than the rounding of both explains.
"""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from checks import agreement, code, page

ROOT = Path(__file__).resolve().parents[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("arms", nargs="*", help="names of tables in arms/")
    parser.add_argument("--ulna", type=Path, help="the program, if it has been built")
    parser.add_argument("--rust", type=Path, help="the library of benches/peers, if it has been built: the arms in it are compared")
    parser.add_argument("--known", action="store_true", help="ask for nothing anew: the page says of how much nothing is known yet")
    parser.add_argument("--output", type=Path, help="the page; docs/c.md if no arm is named")
    parser.add_argument("--jobs", type=int, default=2, help="arms at a time")
    options = parser.parse_args()
    code.known_alone = options.known
    names = options.arms or sorted(path.stem for path in (ROOT / "arms").glob("*.toml"))
    ulna = options.ulna.resolve() if options.ulna else code.program()
    rust = options.rust.resolve() if options.rust else code.rust()

    def one(name):
        done = code.checked(name, code.generated(ulna, name))
        print(name, "compiled, checked, run", file=sys.stderr, flush=True)
        return done

    with ThreadPoolExecutor(options.jobs) as pool:
        checked = list(pool.map(one, names))
    whole = [name for name in names if agreement.is_compiled(name)]
    differences = [difference for name in whole for difference in agreement.differences(name, rust)]
    text = page.page(checked, differences)
    output = options.output or (None if options.arms else ROOT / "docs/c.md")
    if output:
        output.write_text(text)
    print(text)
    sys.exit(any(one.faults for one in checked) or any(not difference.explained for difference in differences))


if __name__ == "__main__":
    main()
