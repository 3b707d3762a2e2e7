"""Shards as tasks of Ray."""

from __future__ import annotations

import importlib
import logging
import os
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

from . import _ulna
from ._progress import Report
from ._scenario import Scenario

#: A shard is made so many times again when its worker is lost: by then it is the shard that loses workers.
RETRIES = 10
#: The most bytes of a shard's rows: they are in the memory of a worker and of this process.
MOST_BYTES = 64_000_000
#: Many enough that a worker's start and the way back are nothing beside them, some seconds.
MOST_CASES = 50_000
#: Fewer are not worth a task.
LEAST_CASES = 1_000
#: Where there are no more cases than that, so many shards share them evenly among workers.
SHARDS = 256


def library() -> Any:
    """Ray itself.

    Raises:
        ModuleNotFoundError: it is not installed.
    """
    try:
        # By its name, so that nobody who has not installed it misses its types.
        return importlib.import_module("ray")
    except ImportError as error:
        raise ModuleNotFoundError(
            f'engine="ray" takes Ray, which is not installed here ({error}): `pip install ray`, or `pip install "ulna[ray]"`'
        ) from error


def shards(native: _ulna.Campaign, asked: int | None) -> int:
    """How many shards: what the number of cases makes of it, and nothing else, so that a second call finds those of the first."""
    # Of the longest numbers.
    row = 200 + 90 * len(native.laws)
    most = MOST_BYTES // row
    if asked is None:
        size = min(most, MOST_CASES, max(LEAST_CASES, -(-native.cases // SHARDS)))
        return -(-native.cases // size)
    if native.cases > most * asked:
        least = -(-native.cases // most)
        raise ValueError(
            f"shards: {asked} of {native.cases} cases have more than {MOST_BYTES // 1_000_000} MB each, which is kept in memory; "
            f"make {least} or more"
        )
    return asked


def make(
    native: _ulna.Campaign,
    scenario: Scenario,
    folder: Path,
    shards: int,
    threads: int | None,
    address: str | None,
    report: Report,
) -> int:
    """Makes all shards that are not in ``folder``, and returns how many cases that were."""
    report.says("looking for shards from before")
    missing = [number for number in range(1, shards + 1) if not native.is_there(folder, (number, shards))]
    made = sum(native.size(number, shards) for number in missing)
    done = native.cases - made
    there = shards - len(missing)
    report.shards(there, shards)
    report.cases(done)
    if not missing:
        return 0
    ray = library()
    task = (*scenario._native.state, native.cases, native.seed)
    with _connected(ray, threads, address):
        function = ray.remote(_shard)
        running: dict[Any, int] = {}
        todo = iter(missing)

        def start(count: int) -> None:
            for number in islice(todo, count):
                # A process that works on it is called so, in `ps` and on Ray's dashboard.
                name = f"ulna-shard-{number}-of-{shards}"
                options = function.options(name=name, num_cpus=1, max_retries=RETRIES)
                running[options.remote(*task, number, shards)] = number

        try:
            start(_in_flight(ray))
            while running:
                # Not for ever, so that Ctrl-C is heard.
                finished, _ = ray.wait(list(running), num_returns=1, timeout=1.0)
                for reference in finished:
                    number = running.pop(reference)
                    native.store(folder, number, shards, *_result(ray, reference, number, shards))
                    done += native.size(number, shards)
                    there += 1
                    report.shards(there, shards)
                    report.cases(done)
                start(max(0, _in_flight(ray) - len(running)))
        finally:
            for reference in running:
                ray.cancel(reference, force=True)
    return made


def _shard(text: str, source: Path, table: str, cases: int, seed: int, number: int, shards: int) -> tuple[bytes, bytes]:
    """What a worker does: the rows of a shard and its manifest."""
    return _campaign(text, source, table, cases, seed).shipped(number, shards, 1, Report.nothing)


#: The campaign that this worker was last at: machine code is made of a table once by each, not for each shard.
_last: tuple[tuple[object, ...], _ulna.Campaign] | None = None


def _campaign(text: str, source: Path, table: str, cases: int, seed: int) -> _ulna.Campaign:
    """The campaign of a task."""
    global _last
    task = (text, source, table, cases, seed)
    if _last is None or _last[0] != task:
        _last = (task, _ulna.Campaign(_ulna.restore_scenario(text, source, table), cases, seed))
    return _last[1]


def _result(ray: Any, reference: Any, number: int, shards: int) -> tuple[bytes, bytes]:
    try:
        result: tuple[bytes, bytes] = ray.get(reference)
        return result
    except ray.exceptions.RayTaskError as error:
        cause = getattr(error, "cause", None) or error
        raise _ulna.CampaignError(f"shard {number} of {shards} cannot be made by a worker: {cause}") from error
    except ray.exceptions.RayError as error:
        raise _ulna.CampaignError(
            f"shard {number} of {shards}: its worker was lost {RETRIES + 1} times, by want of memory perhaps; "
            f"the shards that are made stay, and a second call goes on ({type(error).__name__})"
        ) from error


def _in_flight(ray: Any) -> int:
    """So many tasks are given out at a time: every core has one, and the next is ready. A cluster may grow meanwhile."""
    return 2 * max(1, int(ray.cluster_resources().get("CPU", 1)))


@contextmanager
def _connected(ray: Any, threads: int | None, address: str | None) -> Iterator[None]:
    """Ray, started or connected to unless it is already."""
    if ray.is_initialized():
        yield
        return
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": logging.ERROR}
    if address is not None:
        options["address"] = address
    elif not os.environ.get("RAY_ADDRESS"):
        options.update(num_cpus=threads, include_dashboard=False)
        # Of one that somebody else has started, it is for them to say.
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    ray.init(**options)
    try:
        yield
    finally:
        ray.shutdown()
