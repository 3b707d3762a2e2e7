"""Writes ``ulna/_methods.py`` from the table of methods that the native half was compiled with.

    python tools/write_methods.py
"""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

from ulna import _ulna

FILE = Path(__file__).parent.parent / "ulna" / "_methods.py"

HEAD = '''"""The methods of an arm. Written by ``tools/write_methods.py`` from the table of methods in ``src/arm/methods.rs``; not to be edited."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Doubles.
Array = NDArray[np.float64]


class Methods:
    """Every method of an arm of ``n`` joints; :class:`Arm` says what they have in common."""

    __slots__ = ()

    def _call(self, method: str, arguments: tuple[ArrayLike, ...], out: Any, threads: int | None) -> Any:
        raise NotImplementedError
'''

#: What Rust's docs say for links to other items, and Python's readers cannot follow.
LINK = re.compile(r"\[([^\]]+)\]\((?:crate|Self)::[^)]*\)")


def plain(line: str) -> str:
    """A line of Rust's docs for Python's: without links, ``code`` in double ticks."""
    line = LINK.sub(r"\1", line.removeprefix(" "))
    line = re.sub(r"\[`crate::([^`]+)`\]", r"`\1` of the Rust crate `ulna`", line)
    line = re.sub(r"\[(`[^`]+`)\]", r"\1", line)
    return re.sub(r"`([^`]+)`", r"``\1``", line)


def shape(axes: list[str]) -> str:
    return f"``({', '.join(['...', *axes])})``"


def returned(parts: list[list[str]]) -> tuple[str, str]:
    """Type and shape of what is returned."""
    if len(parts) == 1:
        (axes,) = parts
        if axes:
            return "Array", f"{shape(axes)}."
        return "Any", "a number, or ``(...)``."
    kinds = ["Array" if axes else "Any" for axes in parts]
    shapes = [shape(axes) if axes else "a number or ``(...)``" for axes in parts]
    return f"tuple[{', '.join(kinds)}]", f"a tuple of {', '.join(shapes)}."


def filled(text: str, indent: str, hanging: str = "") -> str:
    return textwrap.fill(text, 140, initial_indent=indent, subsequent_indent=indent + hanging, break_on_hyphens=False)


def method(name: str, arguments: list[tuple[str, str]], documentation: list[str], parts: list[list[str]]) -> str:
    names = [argument for argument, _ in arguments]
    taken = "".join(f"{argument}: ArrayLike, " for argument in names)
    kind, shapes = returned(parts)
    out = "Array" if len(parts) == 1 else "tuple[Array, ...]"
    paragraphs = "\n".join(map(plain, documentation)).split("\n\n")
    body = [filled(" ".join(paragraph.split()), " " * 8) for paragraph in paragraphs]
    lengths = {"wrench": "6"}
    body.append(
        "        Args:\n"
        + "\n".join(
            filled(f"{argument}: {plain(meaning)}, {shape([lengths.get(argument, 'n')])}.", " " * 12, "    ")
            for argument, meaning in arguments
        )
    )
    body.append(f"        Returns:\n{filled(shapes, ' ' * 12)}")
    text = "\n\n".join(body).lstrip()
    return f'''
    def {name}(
        self, {taken}*, out: {out} | None = None, threads: int | None = None
    ) -> {kind}:
        """{text}
        """
        return self._call("{name}", ({", ".join(names)},), out, threads)
'''


def module() -> str:
    return HEAD + "".join(method(*row) for row in _ulna.methods())


if __name__ == "__main__":
    FILE.write_text(module(), encoding="utf-8")
