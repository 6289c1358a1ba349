"""A comparison as text for a terminal, as JSON and as Markdown for a pull request."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from rapidsim.comparison.changes import At, Change, Comparison, FindingChange, TimeChange

_MOST_LINES = 20
SAME = "No difference."


def as_text(comparison: Comparison) -> str:
    """A block of lines a subject."""
    return "\n\n".join("\n".join(block) for block in _blocks(comparison)) + "\n"


def as_markdown(comparison: Comparison) -> str:
    """Headings and lists, the figures as a table."""
    lines = [f"### {comparison.names[0]} → {comparison.names[1]}", ""]
    for title, *rest in _blocks(comparison):
        if not rest:
            lines += [title, ""]
            continue
        lines += [f"**{title}**", "", *(f"- {_escaped(line.strip())}" for line in rest), ""]
    return "\n".join(lines)


def as_json(comparison: Comparison) -> dict[str, object]:
    """All of it but the paths."""
    run = comparison.run
    return {
        "schema": 1,
        "names": list(comparison.names),
        "same": comparison.is_same,
        "changes": [asdict(change) for change in comparison.changes],
        "findings": [asdict(finding) for finding in comparison.findings],
        "run": None
        if run is None
        else {
            "before_s": run.before_s,
            "after_s": run.after_s,
            "ends": list(run.ends),
            "motion_models": list(run.motion_models),
            "routines": [asdict(change) for change in run.routines],
            "lines": [asdict(change) for change in run.lines],
            "outputs": [asdict(change) for change in run.outputs],
        },
        "why_no_run": comparison.why_no_run,
    }


def change_line(change: Change) -> str:
    """One change of the program in a line."""
    where = f" in {change.routine}" if change.routine else ""
    named = "" if change.routine else f" `{change.name}`"
    return f"{change.kind}{named}{where}: {change.message}{_places(change.old, change.new)}"


def time_line(change: TimeChange) -> str:
    """One change of a time in a line."""
    before = "not run" if change.before_s is None else f"{change.before_s:.3f} s"
    after = "not run" if change.after_s is None else f"{change.after_s:.3f} s"
    what = f"{change.routine}: {change.what}" if change.what else change.routine
    return f"{what}: {before} -> {after} ({change.delta_s:+.3f} s)"


def finding_line(finding: FindingChange) -> str:
    """A finding that is new or gone in a line."""
    sign = "new " if finding.is_new else "gone"
    at = f" ({_place(finding.at)})" if finding.at else ""
    return f"{sign} {finding.severity}[{finding.code}] {finding.message}{at}"


def _blocks(comparison: Comparison) -> Iterator[list[str]]:
    if comparison.is_same:
        yield [SAME]
    if comparison.changes:
        yield ["Program", *(f"  {change_line(one)}" for one in comparison.changes)]
    run = comparison.run
    if run is not None and not run.is_same:
        delta_s = run.after_s - run.before_s
        lines = [f"  all: {run.before_s:.3f} s -> {run.after_s:.3f} s ({delta_s:+.3f} s)"]
        if run.other_model:
            lines.append(f"  {run.other_model}")
        if run.ends[0] != run.ends[1]:
            lines.append(f"  it ended otherwise: {run.ends[0]} -> {run.ends[1]}")
        lines += [f"  {time_line(one)}" for one in run.routines]
        yield ["Time by routine", *lines]
        if run.lines:
            shown = [f"  {time_line(one)}" for one in run.lines[:_MOST_LINES]]
            if len(run.lines) > _MOST_LINES:
                shown.append(f"  ... and {len(run.lines) - _MOST_LINES} more")
            yield ["Time by line", *shown]
        if run.outputs:
            yield ["Outputs", *(f"  {one.signal}: {one.message}" for one in run.outputs)]
    if comparison.findings:
        yield ["Findings", *(f"  {finding_line(one)}" for one in comparison.findings)]
    if comparison.why_no_run:
        yield [f"No times: {comparison.why_no_run}."]


def _places(old: At | None, new: At | None) -> str:
    if old is None or new is None:
        at = new or old
        return f" ({_place(at)})" if at else ""
    if Path(old.file).name == Path(new.file).name and old.line == new.line:
        return f" ({_place(new)})"
    return f" ({_place(old)} -> {_place(new)})"


def _place(at: At) -> str:
    return f"{Path(at.file).name}:{at.line}"


def _escaped(line: str) -> str:
    return line.replace("*", "\\*").replace("<", "&lt;")
