"""Answers of the tools, from which their output schemas are made.

A tool that cannot use its input answers with `error` alone.
"""

from __future__ import annotations

from typing import Any

from typing_extensions import TypedDict


class InputErrorAnswer(TypedDict):
    """Reason why the input cannot be used."""

    message: str
    help: str | None
    similar: list[str]


class FindingRecord(TypedDict, total=False):
    """One finding; lines and columns count from 1."""

    code: str
    severity: str
    message: str
    file: str
    line: int
    column: int
    help: str
    fixable: bool


class UncheckedRecord(TypedDict):
    """A move whose reach is not known, and the reason."""

    file: str
    line: int
    reason: str


class CoverageRecord(TypedDict):
    """Numbers of moves."""

    moves: int
    checked: int


class TextRecord(TypedDict):
    """A text for the operator, with its virtual time [s]."""

    time_s: float
    task: str
    text: str


class ConfigurationRecord(TypedDict):
    """Axes [deg] that reach a target, and their configuration."""

    joints_deg: list[float]
    conf: list[int]
    is_stored: bool


class RoutineAnswer(TypedDict, total=False):
    """An instruction or function of RAPID."""

    name: str
    signature: str
    simulated: bool
    error: InputErrorAnswer


class CheckAnswer(TypedDict, total=False):
    """Answer of `check`."""

    ok: bool
    findings: list[FindingRecord]
    unchecked: list[UncheckedRecord]
    coverage: CoverageRecord
    qualifications: list[str]
    next_cursor: int | None
    error: InputErrorAnswer


class RunToolAnswer(TypedDict, total=False):
    """Answer of `run`."""

    ok: bool
    headline: str
    end: str
    time_s: float
    moves: int
    findings: list[FindingRecord]
    texts: list[TextRecord]
    next_cursor: int | None
    error: InputErrorAnswer


class FixAnswer(TypedDict, total=False):
    """Answer of `fix`."""

    ok: bool
    files: dict[str, str]
    fixed: int
    findings: list[FindingRecord]
    next_cursor: int | None
    error: InputErrorAnswer


class DiffAnswer(TypedDict, total=False):
    """Answer of `diff`."""

    same: bool
    changes: list[dict[str, Any]]
    next_cursor: int | None
    error: InputErrorAnswer


class ReachAnswer(TypedDict, total=False):
    """Answer of `reach`."""

    robot: str
    reachable: bool
    configurations: list[ConfigurationRecord]
    reason: str | None
    error: InputErrorAnswer


class ExplainAnswer(TypedDict, total=False):
    """Answer of `explain`."""

    code: str
    name: str
    severity: str
    explanation: str
    error: InputErrorAnswer


class SearchAnswer(TypedDict, total=False):
    """Answer of `search_library`."""

    count: int
    routines: list[RoutineAnswer]
    next_cursor: int | None
    error: InputErrorAnswer
