"""The compiled part of the package."""

from typing import Any, Literal, Mapping, Sequence, TypedDict

import numpy as np

Array = np.ndarray[Any, np.dtype[Any]]

class Given(TypedDict):
    name: str
    number: str | None
    points: list[list[str]]

class ProblemFacts(TypedDict):
    given: list[Given]
    has_fixed_top: bool
    title: str | None
    wave_speed: float
    round_trip: float
    damping_ratio: float
    speed_ratio: float | None

class HistoryFacts(TypedDict):
    numbers: Literal["double", "exact", "digits", "certified"]
    question: str
    end: Any
    ending: str
    engine: str
    scales: list[float]

class Listed(TypedDict):
    name: str
    values: Any
    bounds: Array
    missing: list[tuple[int, str]]

class Described(TypedDict):
    name: str
    unit: str
    meaning: str

class Data(TypedDict):
    name: str
    columns: list[str]
    arrays: list[Array] | None

class Report(TypedDict):
    json: str
    table: str
    warnings: list[str]
    samples: list[list[tuple[str, Array]]]

def main(arguments: list[str]) -> int: ...
def run_command(arguments: list[str]) -> None: ...
def scenes() -> list[list[str]]: ...
def bars(text: str) -> list[bool]: ...
def unknown_parameter(name: str) -> str | None: ...
def sweep(
    base: Problem, quantities: Any, time: Any, accuracy: Any, varied: list[tuple[str, list[Any]]]
) -> tuple[list[str], list[tuple[Array, Array]], list[tuple[int, str]]]: ...

class Problem:
    def __new__(
        cls, first: Mapping[str, Any] | str | tuple[str, int], *replaced: Mapping[str, Any]
    ) -> Problem: ...
    def to_toml(self) -> str: ...
    def facts(self) -> ProblemFacts: ...
    def solve(self, digits: Any, exact: Any, certified: Any, accuracy: Any, first_contact: Any) -> History: ...

class History:
    def facts(self) -> HistoryFacts: ...
    def warnings(self) -> list[str]: ...
    def error_estimate(self) -> float: ...
    def sheet(self) -> str: ...
    def span(self) -> list[float]: ...
    def kinds(self) -> tuple[list[str], list[float]]: ...
    def describe(self, table: str) -> list[Described]: ...
    def table(self, table: str) -> list[Listed]: ...
    def derivatives(self, by: Any, table: str) -> list[list[Listed]]: ...
    def derivatives_at(
        self, by: Any, times: Any, quantities: Any, points: Any, side: Any
    ) -> list[list[Listed]]: ...
    def columns(self, times: Any, quantities: Any, side: Any) -> list[tuple[str, Any]]: ...
    def field(self, points: Any, times: Any, side: Any) -> list[tuple[str, Any]]: ...
    def grid(self, points: Any, times: Any, side: Any, kind: Any) -> list[tuple[str, Any]]: ...

class BodyFacts(TypedDict):
    name: str | None
    length: str
    mass: str | None

class ChainFacts(TypedDict):
    title: str | None
    bodies: list[BodyFacts]
    values: list[tuple[str, str]]
    quantities: list[Described]

class ChainHistoryFacts(TypedDict):
    numbers: Literal["double", "exact", "digits", "certified"]
    question: str
    end: Any
    ending: str

class ListedRows(TypedDict):
    words: list[tuple[str, list[str]]]
    numbers: list[Listed]

class Pieces(TypedDict):
    numbers: list[Listed]
    series: list[Any]

class Chain:
    def __new__(cls, text: str, replaced: list[tuple[str, Any]]) -> Chain: ...
    def facts(self) -> ChainFacts: ...
    def solve(self, digits: Any, exact: Any, certified: Any, accuracy: Any) -> ChainHistory: ...

class ChainHistory:
    def facts(self) -> ChainHistoryFacts: ...
    def warnings(self) -> list[str]: ...
    def table(self, table: str) -> ListedRows: ...
    def force_pieces(self, node: Any) -> Pieces: ...
    def columns(self, times: Any, quantities: Any, side: Any) -> list[tuple[str, Any]]: ...
    def field(self, body: Any, points: Any, times: Any, side: Any) -> list[tuple[str, Any]]: ...
    def derivatives(self, by: Any, table: str) -> list[list[Listed]]: ...
    def derivatives_at(self, by: Any, times: Any, quantities: Any, side: Any) -> list[list[Listed]]: ...

class Comparison:
    def __new__(cls, problem: Problem, data: Sequence[Data], given: Mapping[str, Any]) -> Comparison: ...
    def report(self) -> Report: ...
    def failures(self, above: list[str], below: list[str]) -> list[str]: ...
