"""Results of checks of the moves and of runs, which follow the edits made since.

They come late, from another process. Until the next ones come, those that an edit leaves alone
stay in their places.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace

from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.values import value_class
from rapidsim.workspace.changes import TextChange


@value_class(frozen=True, slots=True)
class RunMove:
    """A move of a run, and where the text has it."""

    start: int
    end: int
    """Offset past the statement."""
    to: str
    """Target as written; empty if it is not named."""
    start_s: float
    end_s: float
    corner: str
    """`fly-by`, `stop` or `stop(corner path failure)`."""
    corner_reason: str
    """Why the zone is not the programmed one; empty where it is."""
    joints_deg: tuple[float, ...]
    conf: tuple[int, ...]


@value_class(frozen=True, slots=True)
class RunSummary:
    """A run as a whole."""

    entry: str
    """The procedure that ran."""
    end: str
    """`ended`, `stopped`, `time_limit`, `cycle_limit` or `error`."""
    time_s: float
    moves: int
    problem: str = ""
    """Why there is no run; empty if there is one."""
    recording: str = ""
    """Path of the recording; empty without one."""

    @property
    def sentence(self) -> str:
        """The run in a sentence."""
        if self.problem:
            return f"{self.entry}: {self.problem}"
        text = f"{self.entry}: {self.end} after {self.time_s:.3f} s, {self.moves} moves"
        return f"{text}; recorded: rerun {self.recording}" if self.recording else text


@value_class(frozen=True, slots=True)
class RunResults:
    """Findings about moves and runs, and the moves of the last run, by path."""

    findings: Mapping[str, tuple[Diagnostic, ...]] = field(default_factory=dict)
    moves: Mapping[str, tuple[RunMove, ...]] = field(default_factory=dict)
    summary: RunSummary | None = None

    def after(self, path: str, changes: Sequence[TextChange], text: str) -> RunResults:
        """Return the results after changes of a text.

        Args:
            path: The file.
            changes: Changes in their order.
            text: The text that they left.
        """
        findings, moves = self.findings.get(path, ()), self.moves.get(path, ())
        if not findings and not moves:
            return self
        source = Source(path, text)
        shifted: list[Diagnostic] = []
        for one in findings:
            span = None if one.span is None else _shifted(one.span.start, one.span.end, changes)
            if span is not None:
                # Places in the old text would mislead.
                shifted.append(replace(one, span=Span(source, *span), related=()))
        places = [(one, _shifted(one.start, one.end, changes)) for one in moves]
        return RunResults(
            {**self.findings, path: tuple(shifted)},
            {
                **self.moves,
                path: tuple(
                    replace(one, start=place[0], end=place[1])
                    for one, place in places
                    if place is not None
                ),
            },
            self.summary,
        )

    def about_target(self, name: str) -> Iterator[str]:
        """Yield sentences about a target: how the arm stands there, or why it cannot."""
        key = name.lower()
        arrivals = [one for moves in self.moves.values() for one in moves if one.to.lower() == key]
        if arrivals:
            last = arrivals[-1]
            joints = ", ".join(f"{angle:.1f}" for angle in last.joints_deg)
            turns = ", ".join(map(str, last.conf))
            yield f"In the last run: joints {joints}; configuration {turns}."
        # Several moves to a target have the same finding.
        yield from dict.fromkeys(
            f"{found.code}: {found.message}."
            for findings in self.findings.values()
            for found in findings
            if f"`{key}`" in found.message.lower()
        )


NO_RESULTS = RunResults()


def _shifted(start: int, end: int, changes: Sequence[TextChange]) -> tuple[int, int] | None:
    """Return a span after changes; None if one of them is inside."""
    for change in changes:
        if change.end <= start:
            shift = len(change.text) - (change.end - change.start)
            start, end = start + shift, end + shift
        elif change.start < end:
            return None
    return start, end
