"""Code actions: fixes of findings, all safe fixes at once, and suppression of a finding."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lsprotocol import types as lsp

from rapidsim.diagnostics import Diagnostic, Fix
from rapidsim.jobs.checking.fixes import harmless_fixes
from rapidsim.lsp.diagnostics import diagnostic_of
from rapidsim.lsp.view import Document, View

FIX_ALL = "source.fixAll.rapidsim"
KINDS = (lsp.CodeActionKind.QuickFix, FIX_ALL)
_SUPPRESSION = re.compile(r"!+\s*rapidsim:\s*ignore\s*\[([^\]]*)\]", re.IGNORECASE)


def code_actions(
    document: Document,
    range_: lsp.Range,
    findings: Sequence[Diagnostic],
    only: Sequence[str] = (),
) -> list[lsp.CodeAction]:
    """Return the actions for a range of a document.

    Args:
        document: The text.
        range_: What is selected.
        findings: All findings in the document.
        only: Kinds that the client wants; none means all.
    """
    start, end = document.offset(range_.start), document.offset(range_.end)
    here = [
        one
        for one in findings
        if one.span is not None and one.span.start <= end and one.span.end >= start
    ]
    actions: list[lsp.CodeAction] = []
    if _is_wanted(lsp.CodeActionKind.QuickFix, only):
        for finding in here:
            actions += _fixes(document, finding)
        actions += _suppressions(document, here)
    if _is_wanted(FIX_ALL, only) and any(one.fix and one.fix.safe for one in findings):
        actions.append(
            lsp.CodeAction(
                title="Fix all that is safe to fix",
                kind=FIX_ALL,
                data={"uri": document.uri},
            )
        )
    return actions


def resolve_fix_all(document: Document, findings: Sequence[Diagnostic]) -> lsp.WorkspaceEdit:
    """Return the edits of all safe fixes in a document that leave no more errors than there are."""
    task = document.view.workspace.task_of(document.path)
    chosen = harmless_fixes(findings, [task], unsafe=False)
    view = document.view
    return view.workspace_edit(
        {
            path: [lsp.TextEdit(view.lines(path).range(start, end), new) for start, end, new in of]
            for path, of in chosen.edits.items()
        }
    )


def _fixes(document: Document, finding: Diagnostic) -> Iterator[lsp.CodeAction]:
    fix = finding.fix
    if fix is None:
        return
    yield lsp.CodeAction(
        title=f"{fix.title[:1].upper()}{fix.title[1:]}",
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[diagnostic_of(document, finding)],
        is_preferred=fix.safe,
        edit=_edit_of(document.view, fix),
    )


def _edit_of(view: View, fix: Fix) -> lsp.WorkspaceEdit:
    edits: dict[str, list[lsp.TextEdit]] = {}
    for edit in fix.edits:
        edits.setdefault(edit.span.file, []).append(
            lsp.TextEdit(view.span_range(edit.span), edit.text)
        )
    return view.workspace_edit(edits)


def _suppressions(document: Document, findings: Sequence[Diagnostic]) -> Iterator[lsp.CodeAction]:
    seen: set[str] = set()
    for finding in findings:
        if finding.span is None or finding.code in seen:
            continue
        seen.add(finding.code)
        edit = _suppression(document, finding.span.end, finding.code)
        yield lsp.CodeAction(
            title=f"Suppress {finding.code} here",
            kind=lsp.CodeActionKind.QuickFix,
            diagnostics=[diagnostic_of(document, finding)],
            edit=document.view.workspace_edit({document.path: [edit]}),
        )


def _suppression(document: Document, offset: int, code: str) -> lsp.TextEdit:
    """Return the edit that adds a comment for a code to the line of an offset."""
    source, spaced = document.file.source.written, document.file.source
    number = source.position(offset)[0]
    start = source.line_starts[number - 1]
    line = source.line(number)
    if (present := _SUPPRESSION.search(line)) is not None:
        place = start + present.end(1)
        codes = present[1].strip()
        return lsp.TextEdit(document.range(place, place), f",{code}" if codes else code)
    begin, end = spaced.address(start), spaced.address(start + len(line))
    comments = (one for one in document.file.comments if begin <= one.start <= end)
    if next(comments, None) is not None:
        indent = line[: len(line) - len(line.lstrip())]
        text = f"{indent}! rapidsim: ignore[{code}]{_line_end(document.text)}"
        return lsp.TextEdit(document.range(start, start), text)
    place = start + len(line.rstrip())
    return lsp.TextEdit(document.range(place, place), f" ! rapidsim: ignore[{code}]")


def _line_end(text: str) -> str:
    found = re.search(r"\r+\n|\n|\r", text)
    return found.group() if found else "\n"


def _is_wanted(kind: str, only: Sequence[str]) -> bool:
    """Whether a client wants a kind: one that it names, or a kind below it."""
    return not only or any(kind == one or kind.startswith(f"{one}.") for one in only)
