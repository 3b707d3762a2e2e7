"""How far a campaign is: a line on stderr, or a function that is told."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: The line changes at most so often, s.
_PERIOD = 0.2


class Report:
    """Hears how many cases are there, and passes it on."""

    def __init__(self, total: int, tell: Callable[[int, int], object] | None, line: bool) -> None:
        self._total = total
        self._tell = tell
        self._line = line
        self._first: tuple[float, int] | None = None
        self._shown = 0.0
        self._shards = ""

    def cases(self, done: int) -> None:
        """So many are there; the first call is about those from before."""
        if self._tell:
            self._tell(done, self._total)
        now = time.monotonic()
        if self._first is None:
            self._first = (now, done)
        if self._line and (now - self._shown > _PERIOD or done == self._total):
            self._shown = now
            start, before = self._first
            self.says(f"{self._shards}{done} of {self._total} cases{_pace(done - before, self._total - done, now - start)}")

    def more(self, before: int, done: int) -> None:
        """So many are there beside those of ``before``."""
        self.cases(before + done)

    def shards(self, done: int, total: int) -> None:
        """So many shards are there; said before the cases are counted."""
        self._shards = f"{done} of {total} shards, "

    def says(self, text: str) -> None:
        """What is done now."""
        if self._line:
            sys.stderr.write(f"\r\x1b[K{text}")
            sys.stderr.flush()

    def ends(self) -> None:
        """Takes the line away."""
        self.says("")

    @staticmethod
    def nothing(_: int) -> None:
        """For what is counted and told to nobody."""


def _pace(made: int, left: int, seconds: float) -> str:
    if made <= 0 or seconds <= 0.0:
        return ""
    pace = made / seconds
    return f", {pace:.0f} a second, {left / pace:.0f} s left"


@contextmanager
def reporting(total: int, progress: bool | Callable[[int, int], object]) -> Iterator[Report]:
    """A report as ``progress`` asks for it."""
    tell = progress if callable(progress) else None
    line = tell is None and bool(progress) and sys.stderr.isatty()
    report = Report(total, tell, line)
    try:
        yield report
    finally:
        report.ends()
