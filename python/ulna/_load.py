"""From a file or a text to an arm."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from . import _ulna
from ._arm import Arm

#: Files that are read as robot descriptions.
_DESCRIPTIONS = (".urdf", ".xml")


def load(
    path: str | os.PathLike[str],
    *,
    base: str | None = None,
    tip: str | None = None,
    drop: Sequence[str] = (),
    accept_inertia: Sequence[str] = (),
    parallel: Sequence[str] = (),
    name: str | None = None,
) -> Arm:
    """The arm of a table (``.toml``) or of a robot description (``.urdf``).

    What is legal and rarely meant is a :class:`TableWarning`. The keywords are for robot descriptions alone: those of ``ulna import``.

    Args:
        path: the file. Nothing else is opened.
        base: the link at which the arm begins, whose frame becomes the world's; the robot's root without it.
        tip: the link at which it ends, whose frame becomes the tool's; the end of the only chain of joints without it.
        drop: links that are left out, with all that hangs on them.
        accept_inertia: links whose inertia is taken over although no rigid body can have it.
        parallel: joints whose axis is taken as parallel to that of the joint before, if they are almost.
        name: the arm's name; the robot's without it.

    Raises:
        TableError: every error in a table, with its place and what to write instead.
        DescriptionError: likewise of a robot description.
    """
    options = _options(path, base, tip, drop, accept_inertia, parallel, name)
    if options is None:
        return Arm(_ulna.read_table(path, None))
    return Arm(_ulna.import_description(path, None, options))


def parse(
    text: str,
    source: str | os.PathLike[str] = "arm.toml",
    *,
    base: str | None = None,
    tip: str | None = None,
    drop: Sequence[str] = (),
    accept_inertia: Sequence[str] = (),
    parallel: Sequence[str] = (),
    name: str | None = None,
) -> Arm:
    """The arm of a text: as :func:`load` of a file ``source`` with that text, which need not exist."""
    options = _options(source, base, tip, drop, accept_inertia, parallel, name)
    if options is None:
        return Arm(_ulna.read_table(source, text))
    return Arm(_ulna.import_description(source, text, options))


def _options(
    path: str | os.PathLike[str],
    base: str | None,
    tip: str | None,
    drop: Sequence[str],
    accept_inertia: Sequence[str],
    parallel: Sequence[str],
    name: str | None,
) -> dict[str, Any] | None:
    """The options of an import; none if the file is a table."""
    given: dict[str, Any] = {
        "base": base,
        "tip": tip,
        "drop": drop,
        "accept_inertia": accept_inertia,
        "parallel": parallel,
        "name": name,
    }
    if os.fspath(path).lower().endswith(_DESCRIPTIONS):
        for option in ("drop", "accept_inertia", "parallel"):
            if isinstance(given[option], str):
                raise TypeError(f"{option}: expected a list of names, found the name {given[option]!r} alone")
            given[option] = list(given[option])
        return given
    for option, value in given.items():
        if value:
            raise TypeError(f"{option}: is for robot descriptions (.urdf), and {os.fspath(path)} is a table")
    return None


def arms() -> list[str]:
    """The names of the arms that come with the package; :func:`arm` gives one."""
    return _ulna.tables()


def arm(name: str) -> Arm:
    """An arm that comes with the package.

    Raises:
        ValueError: none is called so.
    """
    # What its table is warned of is as it is meant.
    return Arm(_ulna.restore(_ulna.tables_text(name), f"{name}.toml", []))
