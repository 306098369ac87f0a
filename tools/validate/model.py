"""What a validation is made of: runs, figures with bands, statements with verdicts, pictures."""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from matplotlib.figure import Figure

from tools.validate.results import Result

Results = dict[str, Result]  # by the labels that a study gives its runs

# What the papers' words are taken to mean. The conference paper calls 0.388 mm "very close" to 0.4 mm, so a deflection
# within that is close. A curve or a field agrees with another that it cannot be told from at a glance: root mean
# square difference, relative to the peak.
CLOSE = 0.03
SAME_CURVE = 0.05


@dataclass(frozen=True)
class Run:
    """A case and what is set in it."""

    case: str  # a folder of examples/, or the path of a file
    settings: tuple[str, ...] = ()

    @property
    def file(self) -> str:
        return self.case if self.case.endswith(".toml") else f"examples/{self.case}/case.toml"


@dataclass(frozen=True)
class Band:
    """An interval, ends included."""

    low: float = -math.inf
    high: float = math.inf

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high

    @classmethod
    def around(cls, value: float, share: float) -> Band:
        return cls(value * (1 - share), value * (1 + share))


@dataclass(frozen=True)
class Check:
    """A figure of ours, what it is compared with, and the band that it must not leave."""

    what: str
    value: float
    reference: float
    band: Band
    why: str

    @property
    def holds(self) -> bool:
        return self.value in self.band


@dataclass(frozen=True)
class Claim:
    """A statement of the papers, or a figure that we want; what its words are taken to mean, and what we find."""

    source: str
    quote: str
    meaning: str
    value: float  # the one number that decides
    claimed: Band  # where it lies if the statement is true
    figure: str  # what we find, in words
    known: bool | None  # the verdict that we know; None where the machine's speed decides
    reason: str = ""  # why it differs, or a remark
    about: str = ""  # which of several things the statement is judged for

    @property
    def agrees(self) -> bool:
        return self.value in self.claimed

    @property
    def holds(self) -> bool:
        return self.known is None or self.agrees == self.known


@dataclass(frozen=True)
class Table:
    caption: str
    head: list[str]
    rows: list[list[str]]


@dataclass(frozen=True)
class Picture:
    file: str
    caption: str
    draw: Callable[[Results], Figure]


@dataclass(frozen=True)
class Study:
    """One case of the papers, or one of ours with a page of its own. The functions see the results under the labels of
    runs."""

    name: str
    title: str
    source: str
    text: str
    runs: Callable[[bool], dict[str, Run]]  # the argument: whether the short set
    tables: Callable[[Results], list[Table]]
    claims: Callable[[Results], list[Claim]]
    checks: Callable[[Results], list[Check]]
    pictures: list[Picture]
    timed: bool = False  # run by themselves, and more than once
    page: str = ""  # the file of its own page
    findings: str = ""  # on its own page, after all figures: what was found, what is left and why
