"""Campaigns: ``campaign`` makes one, on this machine or on a cluster, ``read_campaign`` reads its rows."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from . import _ray, _ulna
from ._progress import Report, reporting
from ._scenario import Scenario


class Campaign(NamedTuple):
    """A campaign that is whole."""

    rows: Path
    """``campaign.csv``: a line for each case, the same bytes whatever made it."""
    record: Path
    """``campaign.json``: which campaign the rows are of, and their SHA-256."""
    cases: int
    """How many cases were asked for; all of them are there."""
    seed: int
    """Of all random numbers."""
    made: int
    """How many of the cases had to be made: what was there from before is not made again."""
    shards: int | None
    """How many shards it was made in; None for one go."""

    def columns(self) -> dict[str, Any]:
        """The rows as arrays: :func:`read_campaign`."""
        return read_campaign(self.rows)


def campaign(
    scenario: Scenario | str | os.PathLike[str],
    *,
    output: str | os.PathLike[str],
    cases: int | None = None,
    seed: int | None = None,
    shards: int | None = None,
    engine: Literal["local", "ray"] = "local",
    threads: int | None = None,
    address: str | None = None,
    progress: bool | Callable[[int, int], object] = True,
) -> Campaign:
    """Varies a scenario: every joint, a grid of failure times, random starts, goals and forces. What ``ulna campaign`` does, but page and figures.

    A case depends on the seed and its number alone, so the rows are the same bytes for any engine, number of shards and of threads, and
    those of the program ``ulna`` of the same version on the same kind of machine. Interrupted, by Ctrl-C too, it goes on where it stopped when
    it is called again: in one go and in local shards with the next cases, with Ray with the shards that are not there. Rows of another
    campaign, and rows that were changed, are refused and left. One call at a time works in a folder.

    Args:
        scenario: a :class:`Scenario`, or the file of one.
        output: the folder that ``campaign.csv`` goes to, made if need be; shards too, each with its manifest. They stay: once the
            campaign is whole they may be removed.
        cases: how many; without it as many as the scenario says.
        seed: of all random numbers; without it the scenario's.
        shards: how many parts it is made in, each a file until all are put together. Without it a local campaign is made in one go, and
            with Ray there are as many as the number of cases asks for.
        engine: ``"local"``, this process on all cores, or ``"ray"``: each shard is a task for one core, on whatever machines a Ray cluster
            has. Nothing but this package need be there: scenario and table travel with the tasks, rows come back as bytes. The shard of
            a worker that is lost is made again by another one.
        threads: how many; without it one for each core. With Ray, of the one that is started here.
        address: of a Ray cluster, such as ``"auto"`` or ``"ray://head:10001"``. Without it that of ``RAY_ADDRESS``, or a Ray is started on this
            machine for as long as it takes. A Ray that the program is connected to already is used as it is.
        progress: True for a line on stderr if that is a terminal; or a function that takes how many cases are there, and how many are asked
            for.

    Raises:
        CampaignError: files cannot be gone on with, put together, read or written; or workers were lost again and again.
        ExperimentError: the scenario's arm cannot execute its motion.
        ScenarioError: every error in the scenario's file.
        ModuleNotFoundError: Ray is not installed.
    """
    if engine not in ("local", "ray"):
        raise ValueError(f'engine: expected "local" or "ray", found {engine!r}')
    if shards is not None and shards < 1:
        raise ValueError(f"shards: expected 1 or more, found {shards}")
    if threads is not None and threads < 1:
        raise ValueError(f"threads: expected 1 or more, found {threads}")
    if address is not None and engine != "ray":
        raise TypeError('address: is for engine="ray"')
    if not isinstance(scenario, Scenario):
        scenario = Scenario.load(scenario)
    native = _ulna.Campaign(scenario._native, cases, seed)
    if shards is not None and shards > native.cases:
        raise ValueError(f"shards: {shards} of {native.cases} cases; there may be as many shards as cases")
    folder = Path(output)
    if engine == "ray":
        # Before anything is made: it may not be there.
        _ray.library()
        shards = _ray.shards(native, shards)
    with reporting(native.cases, progress) as report:
        if shards is None:
            made = native.make(folder, None, threads or 0, report.cases)
        elif native.is_there(folder, None):
            made = 0
        else:
            # The merge takes the folder for itself.
            with native.lock(folder):
                if engine == "ray":
                    made = _ray.make(native, scenario, folder, shards, threads, address, report)
                else:
                    made = _one_by_one(native, folder, shards, threads or 0, report)
            report.says("putting the shards together")
            native.merge(folder, shards, report.nothing)
    return Campaign(folder / "campaign.csv", folder / "campaign.json", native.cases, native.seed, made, shards)


def _one_by_one(native: _ulna.Campaign, folder: Path, shards: int, threads: int, report: Report) -> int:
    """All shards, each on all threads; how many cases had to be made."""
    made = before = 0
    for number in range(1, shards + 1):
        made += native.make(folder, (number, shards), threads, partial(report.more, before))
        before += native.size(number, shards)
    return made


def read_campaign(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The rows of a campaign, or of a shard, as a dictionary of arrays, one for each column, as ``pandas.DataFrame`` takes it.

    All rows are in memory. ``case`` and ``failed_joint`` are integers, and joints count from 0 here, other than in the file; ``status`` is text;
    all others are floats, with NaN where there is no outcome.

    Raises:
        ValueError: it is no file of a campaign.
    """
    path = Path(path)
    with path.open(newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        names = next(rows, [])
        if names[:2] != ["case", "failed_joint"] or "status" not in names:
            raise ValueError(f"{path} is no file of a campaign: its first line does not name the columns of one")
        cells = list(rows)
    if any(len(row) != len(names) for row in cells):
        raise ValueError(f"{path} is no file of a campaign: not every line has {len(names)} cells")
    columns: dict[str, Any] = {}
    for name, column in zip(names, zip(*cells) if cells else [()] * len(names)):
        if name == "status":
            columns[name] = np.array(column, dtype=np.str_)
        elif name in ("case", "failed_joint"):
            columns[name] = np.array(column, dtype=np.int64)
        else:
            columns[name] = np.array([cell or "nan" for cell in column], dtype=np.float64)
    columns["failed_joint"] -= 1
    return columns
