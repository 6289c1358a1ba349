"""A comparison as text for a terminal, as JSON and as Markdown for a pull request."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from rapidsim.applications.diff.changes import (
    Comparison,
    ComparisonReport,
    ConfigurationChange,
    FindingChange,
    ProgramChange,
    RunChange,
    SourcePosition,
    TimeChange,
)
from rapidsim.json_records.encoding import json_of
from rapidsim.values import value_class

_MOST_LINES = 20
_SHOWN_S = 0.001
"""Smaller changes of a time are only counted; JSON lists them all."""
SAME = "No difference."
_OF_THE_ARM = ("model", "urdf", "use_robot_type")
"""Keys of a configuration that name the arm."""
_CODE_SPAN = re.compile(r"(`[^`]*`)")


@value_class(frozen=True, slots=True)
class ReportBlock:
    """Report on one subject; times precede lines."""

    title: str
    lines: tuple[str, ...] = ()
    times: tuple[TimeChange, ...] = ()


def as_text(comparison: Comparison) -> str:
    """Return the report as text, with one block of lines per subject."""
    told = []
    for block in blocks(comparison):
        lines = (*map(_time_line, block.times), *block.lines)
        told.append("\n".join([block.title, *(f"  {line}" for line in lines)]))
    return "\n\n".join(told) + "\n"


def as_markdown(comparison: Comparison) -> str:
    """Return the report as headings and lists, with times as tables."""
    lines = [f"### {comparison.names[0]} → {comparison.names[1]}", ""]
    for block in blocks(comparison):
        if not block.lines and not block.times:
            lines += [block.title, ""]
            continue
        lines += [f"**{block.title}**", ""]
        if block.times:
            lines += ["| | before | after | change |", "|---|--:|--:|--:|"]
            lines += [f"| {' | '.join(map(_table_cell, time_cells(one)))} |" for one in block.times]
            lines.append("")
        if block.lines:
            lines += [*(f"- {_escaped(line)}" for line in block.lines), ""]
    return "\n".join(lines)


def as_json(comparison: Comparison) -> dict[str, object]:
    """Return the report as JSON: everything except the paths."""
    report = ComparisonReport(
        names=comparison.names,
        same=comparison.is_same,
        configuration=comparison.configuration,
        not_compared=comparison.not_compared,
        changes=comparison.changes,
        findings=comparison.findings,
        run=comparison.run,
        no_run_reason=comparison.no_run_reason,
    )
    return json_of(report)


def _change_line(change: ProgramChange) -> str:
    """Return one change of the program as a line."""
    where = f" in {change.routine}" if change.routine else ""
    named = "" if change.routine else f" `{change.name}`"
    return f"{change.kind}{named}{where}: {change.message}{_places(change.old, change.new)}"


def _configuration_line(change: ConfigurationChange) -> str:
    """Return one change of the configuration as a line."""
    kind = "" if change.type == "table" else f"{change.type} "
    key = f", {change.key}" if change.key else ""
    unit = f" {change.unit}" if change.unit else ""
    if change.key:
        note = f" ({change.note})" if change.note else ""
        old, new = ("not set" if one is None else one for one in (change.old, change.new))
        values = f"{old} -> {new}{unit}{note}"
    elif change.old is None:
        values = f"added: {change.new}"
    elif change.new is None:
        values = f"removed: {change.old}"
    else:
        values = f"{change.old} -> {change.new}"
    return f"{change.source}: {kind}`{change.name}`{key}: {values}"


def time_cells(change: TimeChange) -> tuple[str, str, str, str]:
    """Return a change of time as cells: item, before, after, difference."""
    before = "not run" if change.before_s is None else f"{change.before_s:.3f} s"
    after = "not run" if change.after_s is None else f"{change.after_s:.3f} s"
    what = f"{change.routine}: {change.what}" if change.what else change.routine
    return what, before, after, f"{change.delta_s:+.3f} s"


def _time_line(change: TimeChange) -> str:
    what, before, after, delta = time_cells(change)
    return f"{what}: {before} -> {after} ({delta})"


def _finding_line(finding: FindingChange) -> str:
    """Return a new or removed finding as a line."""
    sign = "new " if finding.is_new else "gone"
    at = f" ({_place(finding.at)})" if finding.at else ""
    return f"{sign} {finding.severity}[{finding.code}] {finding.message}{at}"


def blocks(comparison: Comparison) -> Iterator[ReportBlock]:
    """Yield the report, one block per subject."""
    if comparison.is_same:
        yield ReportBlock(SAME)
    if comparison.recordings_differ:
        yield ReportBlock("Recording", ("the content differs",))
    run = comparison.run
    named = any(one.key.lower() in _OF_THE_ARM for one in comparison.configuration)
    if run is not None and run.robots[0] != run.robots[1] and not named:
        yield ReportBlock("Cell", (f"robot: {run.robots[0]} -> {run.robots[1]}",))
    if comparison.configuration:
        yield ReportBlock(
            "Configuration", tuple(map(_configuration_line, comparison.configuration))
        )
    if comparison.changes:
        yield ReportBlock("Program", tuple(map(_change_line, comparison.changes)))
    if run is not None and not run.is_same:
        if run.ends[0] != run.ends[1]:
            yield ReportBlock("End of the run", (_ends_line(run),))
        yield from _time_blocks(run)
        if run.outputs:
            yield ReportBlock(
                "Outputs", tuple(f"{one.signal}: {one.message}" for one in run.outputs)
            )
    if comparison.findings:
        yield ReportBlock("Findings", tuple(map(_finding_line, comparison.findings)))
    for note in comparison.not_compared:
        yield ReportBlock(f"{note[0].upper()}{note[1:]}.")
    if comparison.no_run_reason:
        yield ReportBlock(f"No times: {comparison.no_run_reason}.")


def _ends_line(run: RunChange) -> str:
    before, after = (
        f"{end} ({error})" if error else end
        for end, error in zip(run.ends, run.errors, strict=True)
    )
    return f"{before} -> {after}"


def _time_blocks(run: RunChange) -> Iterator[ReportBlock]:
    notes = [run.other_model] if run.other_model else []
    whole = TimeChange("", "all", "", run.before_s, run.after_s)
    shown, left = _worth_telling(run.routines, len(run.routines))
    yield ReportBlock("Time by routine", (*notes, *left), (whole, *shown))
    if run.lines:
        shown, left = _worth_telling(run.lines, _MOST_LINES)
        yield ReportBlock("Time by line", left, shown)


def _worth_telling(
    changes: Sequence[TimeChange], most: int
) -> tuple[tuple[TimeChange, ...], tuple[str, ...]]:
    """Return steps that are new, gone or visibly changed, and a line on the omitted ones."""
    told = tuple(
        one
        for one in changes
        if None in (one.before_s, one.after_s) or abs(one.delta_s) >= _SHOWN_S
    )
    counts = (
        (len(told) - most, "more"),
        (len(changes) - len(told), f"of less than {_SHOWN_S:g} s"),
    )
    left = " and ".join(f"{count} {how}" for count, how in counts if count > 0)
    return told[:most], (f"... and {left}",) if left else ()


def _places(old: SourcePosition | None, new: SourcePosition | None) -> str:
    if old is None or new is None:
        at = new or old
        return f" ({_place(at)})" if at else ""
    if Path(old.file).name == Path(new.file).name and old.line == new.line:
        return f" ({_place(new)})"
    return f" ({_place(old)} -> {_place(new)})"


def _place(at: SourcePosition) -> str:
    return f"{Path(at.file).name}:{at.line}"


def _escaped(line: str) -> str:
    """Return a text in which only code spans have a meaning in Markdown."""
    parts = _CODE_SPAN.split(line)
    # Text and code spans alternate.
    parts[::2] = (one.replace("*", "\\*").replace("<", "&lt;") for one in parts[::2])
    return "".join(parts)


def _table_cell(text: str) -> str:
    # A table is split at each `|`, in code spans too.
    return _escaped(text).replace("|", "\\|")
