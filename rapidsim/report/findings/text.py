"""Findings as text with source frames, and as one line each."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Sequence

from rapidsim.diagnostics import Diagnostic, Fix, Severity, Span
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.source_frame import printable, source_frame
from rapidsim.report.palette import Palette
from rapidsim.report.quantities import joined, parted

_LISTED_LINES = 6


def full(
    findings: Sequence[Finding], palette: Palette, *, width: int, headlines: int | None = None
) -> str:
    """Each finding with its source text, related places, and the fix or suggestion if known.

    Args:
        findings: The findings to print.
        palette: Colours.
        width: Terminal cells for source text and suggestions.
        headlines: Cells after which a message is broken; None keeps it on one line, for `grep`.
    """
    return "".join(f"{_full(finding, palette, width, headlines)}\n\n" for finding in findings)


def concise(findings: Sequence[Finding], palette: Palette) -> str:
    """One line a finding: `file:line:column: severity[code] message`."""
    return "".join(f"{_concise(finding, palette)}\n" for finding in findings)


def summary_line(
    findings: Sequence[Finding], *, files: int, seconds: float | None, baseline_count: int = 0
) -> str:
    """Summary: numbers of findings, with repeats, and of files, and the duration.

    Args:
        findings: What is shown.
        files: How many files were read.
        seconds: The duration; None omits it.
        baseline_count: How many more findings a baseline holds back.
    """
    counts: Counter[Severity] = Counter()
    for finding in findings:
        counts[finding.first.severity] += 1 + len(finding.repeats)
    kinds = [
        _counted(counts[severity], severity.value) for severity in Severity if severity in counts
    ]
    found = (
        f"Found {_listed(kinds)}"
        if kinds
        else f"Found nothing {'new' if baseline_count else 'wrong'}"
    )
    took = "" if seconds is None else f" ({seconds:.2f} s)"
    return f"{found} in {_counted(files, 'file')}{took}."


def _full(finding: Finding, palette: Palette, width: int, headlines: int | None) -> str:
    diagnostic = finding.first
    colour = palette.of(diagnostic.severity)
    lines = _headline(diagnostic, palette, headlines)
    spans = [diagnostic.span, *(related.span for related in diagnostic.related)]
    gutter = max((len(str(one.line)) for one in spans if one), default=1)
    if span := diagnostic.span:
        within = f" in {diagnostic.routine}" if diagnostic.routine else ""
        arrow = palette.paint(f"{' ' * gutter}-->", palette.frame)
        lines.append(f"{arrow} {_place(span)}{within}")
        lines += source_frame(span, "", palette, colour=colour, width=width, gutter=gutter)
    shown = diagnostic.span
    for related in diagnostic.related:
        if shown is None or related.span.file != shown.file:
            arrow = palette.paint(f"{' ' * gutter}:::", palette.frame)
            lines.append(f"{arrow} {_place(related.span)}")
        label = printable(related.message)
        lines += source_frame(
            related.span, label, palette, colour=palette.note, width=width, gutter=gutter
        )
        shown = related.span
    margin = f"{' ' * gutter} {palette.paint('=', palette.frame)}"
    cures = (
        ("help:", diagnostic.violation.help),
        ("fix:", diagnostic.fix and _fix_title(diagnostic.fix)),
    )
    for label, cure in cures:
        if cure:
            first, *rest = _wrapped(label, cure, width - gutter - 3)
            coloured = first.replace(label, palette.paint(label, palette.help), 1)
            lines.append(f"{margin} {coloured}")
            lines += [f"{' ' * (gutter + 3)}{line}" for line in rest]
    if finding.repeats:
        lines.append(f"{margin} and {len(finding.repeats)} more like it, {_lines_of(finding)}")
    return "\n".join(lines)


def _wrapped(label: str, suggestion: str, width: int) -> list[str]:
    """A suggestion after its label; its line ends are kept, as it may be a text to paste."""
    indent = " " * (len(label) + 1)
    lines: list[str] = []
    for number, line in enumerate(suggestion.splitlines()):
        begin = f"{label} " if number == 0 else indent
        wrapped = textwrap.wrap(
            joined(printable(line)),
            width,
            initial_indent=begin,
            subsequent_indent=indent,
            break_on_hyphens=False,
        )
        lines += map(parted, wrapped)
    return lines


def _headline(diagnostic: Diagnostic, palette: Palette, width: int | None) -> list[str]:
    """Code, name and message, broken between words where there is a width to keep."""
    violation = diagnostic.violation
    code = f"{diagnostic.severity.value}[{violation.code}]"
    message = printable(violation.message)
    head = f"{code} {violation.name}: "
    compare = f" (cf. {violation.cf})" if violation.cf else ""
    whole = f"{head}{message}{compare}"
    parts = (
        (0, len(code), palette.of(diagnostic.severity)),
        (len(code), len(head), ""),
        (len(head), len(head) + len(message), palette.strong),
        (len(head) + len(message), len(whole), ""),
    )
    lines, end = [], 0
    for line in [whole] if width is None else _broken(whole, width):
        start = whole.index(line, end)
        end = start + len(line)
        pieces = ((whole[max(a, start) : min(b, end)], paint) for a, b, paint in parts)
        lines.append("".join(palette.paint(text, paint) for text, paint in pieces))
    return lines


def _broken(text: str, width: int) -> list[str]:
    lines = textwrap.wrap(
        joined(text), width, break_on_hyphens=False, expand_tabs=False, replace_whitespace=False
    )
    return [parted(line) for line in lines]


def _concise(finding: Finding, palette: Palette) -> str:
    diagnostic = finding.first
    violation = diagnostic.violation
    severity = diagnostic.severity
    code = palette.paint(f"{severity.value}[{violation.code}]", palette.of(severity))
    place = f"{_place(diagnostic.span)}: " if diagnostic.span else ""
    repeats = f" (and {len(finding.repeats)} more)" if finding.repeats else ""
    return f"{place}{code} {printable(violation.message)}{repeats}"


def _place(span: Span) -> str:
    return f"{span.file}:{span.line}:{span.column}"


def _lines_of(finding: Finding) -> str:
    lines = sorted({repeat.span.line for repeat in finding.repeats if repeat.span})
    if len(lines) == 1:
        return f"on line {lines[0]}"
    listed = ", ".join(str(line) for line in lines[:_LISTED_LINES])
    return f"on lines {listed}{', ...' if len(lines) > _LISTED_LINES else ''}"


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _listed(parts: Sequence[str]) -> str:
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts)


def _fix_title(fix: Fix) -> str:
    return fix.title if fix.safe else f"{fix.title} (with --unsafe-fixes)"
