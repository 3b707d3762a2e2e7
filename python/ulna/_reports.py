"""What comparisons find."""

from __future__ import annotations

from typing import NamedTuple


class Deviation(NamedTuple):
    """How far a method's numbers are from those that they are compared with, at the worst state."""

    method: str
    error: float
    """The largest error of an entry, relative to what the terms that it is a sum of can amount to."""
    tolerance: float
    """What rounding alone may leave."""
    passes: bool


class Report(NamedTuple):
    """One comparison, method by method. ``str`` gives the table that the program prints."""

    text: str
    passes: bool
    states: int
    deviations: tuple[Deviation, ...]

    def __str__(self) -> str:
        return self.text


class Verification(NamedTuple):
    """What ``ulna verify`` compares. ``str`` gives its text."""

    emitted: Report
    """The programs in doubles beside themselves in 106 bits."""
    textbook: Report
    """The textbook's formulas beside the programs in 106 bits."""
    differences: Report
    """Derivatives beside central differences."""

    @property
    def passes(self) -> bool:
        """Whether nothing differs by more than rounding explains."""
        return all(report.passes for report in self)

    def __str__(self) -> str:
        return (
            f"the emitted program against its own formulas in 106 bits\n{self.emitted}\n"
            f"the generic path against the emitted formulas in 106 bits\n{self.textbook}\n"
            f"the emitted program against central differences of itself\n{self.differences}"
        )
