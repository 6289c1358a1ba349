"""Reports to a client that asks for findings instead of receiving them."""

from __future__ import annotations

from collections.abc import Mapping

from lsprotocol import types as lsp

from rapidsim.lsp.diagnostics import diagnostics_of
from rapidsim.lsp.editor_session import EditorSession, OpenDocument


def document_report(of: OpenDocument, previous: str | None) -> lsp.DocumentDiagnosticReport:
    """Return the findings in a document, or that they are those of the previous report."""
    identifier = of.program.state
    if previous == identifier:
        return lsp.RelatedUnchangedDocumentDiagnosticReport(identifier)
    items = diagnostics_of(of.document, of.findings)
    return lsp.RelatedFullDocumentDiagnosticReport(items, result_id=identifier)


def workspace_report(
    session: EditorSession, previous: Mapping[str, str]
) -> lsp.WorkspaceDiagnosticReport:
    """Return the findings in all documents of all programs.

    Args:
        session: The programs.
        previous: Identifiers of the reports that the client has, by URI.
    """
    reports: list[lsp.WorkspaceDocumentDiagnosticReport] = []
    for of in session.documents():
        uri, identifier = of.document.uri, of.program.state
        if previous.get(uri) == identifier:
            reports.append(lsp.WorkspaceUnchangedDocumentDiagnosticReport(uri, identifier))
            continue
        items = diagnostics_of(of.document, of.findings)
        reports.append(lsp.WorkspaceFullDocumentDiagnosticReport(uri, items, result_id=identifier))
    return lsp.WorkspaceDiagnosticReport(reports)
