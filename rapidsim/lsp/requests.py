"""The requests about one document: a table of methods, functions and options.

No function knows the wire: it takes an open document and the parameters of the protocol.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from lsprotocol import types as lsp

from rapidsim.lsp import (
    call_hierarchy,
    code_actions,
    code_lenses,
    folding,
    formatting,
    hover,
    inlay_hints,
    navigation,
    outline,
    renaming,
    signature_help,
    token_pieces,
)
from rapidsim.lsp.editor_session import OpenDocument
from rapidsim.values import value_class


class RawTokens:
    """Semantic tokens that are sent as they are: a hundred thousand numbers need no conversion.

    A plain class with the names of the protocol, because that is what the wire does not convert.
    """

    def __init__(self, identifier: str | None, data: list[int]) -> None:
        """Take the identifier of the answer, if it can be the base of edits, and the code."""
        self.data = data
        if identifier is not None:
            self.resultId = identifier


@value_class(frozen=True, slots=True)
class DocumentRequest:
    """A request: its function, and what the server declares about it."""

    answer: Callable[[OpenDocument, Any], Any]
    options: Any = None
    is_long: bool = False
    """Whether it may take so long that the client can cancel it or change the text first."""


def _definition(of: OpenDocument, params: lsp.DefinitionParams) -> list[lsp.Location]:
    return navigation.definition(of.document, params.position)


def _type_definition(of: OpenDocument, params: lsp.TypeDefinitionParams) -> list[lsp.Location]:
    return navigation.type_definition(of.document, params.position)


def _references(of: OpenDocument, params: lsp.ReferenceParams) -> list[lsp.Location]:
    return navigation.references(
        of.document, params.position, with_declaration=params.context.include_declaration
    )


def _highlights(
    of: OpenDocument, params: lsp.DocumentHighlightParams
) -> list[lsp.DocumentHighlight]:
    return navigation.document_highlights(of.document, params.position)


def _hover(of: OpenDocument, params: lsp.HoverParams) -> lsp.Hover | None:
    return hover.hover(of.document, params.position, of.program.results)


def _prepare_rename(
    of: OpenDocument, params: lsp.PrepareRenameParams
) -> lsp.PrepareRenamePlaceholder | None:
    return renaming.prepare_rename(of.document, params.position)


def _rename(of: OpenDocument, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    return renaming.rename(of.document, params.position, params.new_name)


def _symbols(of: OpenDocument, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
    return outline.document_symbols(of.document)


def _calls(of: OpenDocument, params: lsp.CallHierarchyPrepareParams) -> list[lsp.CallHierarchyItem]:
    return call_hierarchy.prepare(of.document, params.position)


def _signature(of: OpenDocument, params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
    return signature_help.signature_help(of.document, params.position)


def _folding(of: OpenDocument, params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    return folding.folding_ranges(of.document)


def _selection(of: OpenDocument, params: lsp.SelectionRangeParams) -> list[lsp.SelectionRange]:
    return [folding.selection_range(of.document, one) for one in params.positions]


def _code_actions(of: OpenDocument, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    only = tuple(str(getattr(one, "value", one)) for one in params.context.only or ())
    return code_actions.code_actions(of.document, params.range, of.findings, only)


def _code_lenses(of: OpenDocument, params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    return code_lenses.code_lenses(of.document, of.program.results)


def _inlay_hints(of: OpenDocument, params: lsp.InlayHintParams) -> list[lsp.InlayHint]:
    return inlay_hints.inlay_hints(of.document, params.range, of.program.results)


def _formatting(of: OpenDocument, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    return formatting.format_document(of.document)


def _range_formatting(
    of: OpenDocument, params: lsp.DocumentRangeFormattingParams
) -> list[lsp.TextEdit]:
    return formatting.format_range(of.document, params.range)


def _on_type(of: OpenDocument, params: lsp.DocumentOnTypeFormattingParams) -> list[lsp.TextEdit]:
    return formatting.format_on_type(of.document, params.position)


def _tokens(of: OpenDocument, params: lsp.SemanticTokensParams) -> RawTokens:
    identifier, data = of.program.encoder.full(of.document)
    return RawTokens(identifier, data)


def _token_delta(
    of: OpenDocument, params: lsp.SemanticTokensDeltaParams
) -> RawTokens | lsp.SemanticTokensDelta:
    identifier, found = of.program.encoder.delta(of.document, params.previous_result_id)
    edits = [one for one in found if isinstance(one, lsp.SemanticTokensEdit)]
    if len(edits) == len(found):
        return lsp.SemanticTokensDelta(edits, identifier)
    return RawTokens(identifier, [one for one in found if isinstance(one, int)])


def _tokens_in_range(of: OpenDocument, params: lsp.SemanticTokensRangeParams) -> RawTokens:
    document = of.document
    start, end = document.offset(params.range.start), document.offset(params.range.end)
    return RawTokens(None, of.program.encoder.range(document, start, end))


REQUESTS: Mapping[str, DocumentRequest] = MappingProxyType(
    {
        lsp.TEXT_DOCUMENT_DEFINITION: DocumentRequest(_definition),
        lsp.TEXT_DOCUMENT_TYPE_DEFINITION: DocumentRequest(_type_definition),
        lsp.TEXT_DOCUMENT_REFERENCES: DocumentRequest(_references, is_long=True),
        lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: DocumentRequest(_highlights),
        lsp.TEXT_DOCUMENT_HOVER: DocumentRequest(_hover),
        lsp.TEXT_DOCUMENT_PREPARE_RENAME: DocumentRequest(_prepare_rename),
        lsp.TEXT_DOCUMENT_RENAME: DocumentRequest(_rename, is_long=True),
        lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: DocumentRequest(_symbols),
        lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY: DocumentRequest(_calls),
        lsp.TEXT_DOCUMENT_SIGNATURE_HELP: DocumentRequest(
            _signature,
            lsp.SignatureHelpOptions(trigger_characters=["(", ",", " ", "\\"]),
        ),
        lsp.TEXT_DOCUMENT_FOLDING_RANGE: DocumentRequest(_folding),
        lsp.TEXT_DOCUMENT_SELECTION_RANGE: DocumentRequest(_selection),
        lsp.TEXT_DOCUMENT_CODE_ACTION: DocumentRequest(
            _code_actions,
            lsp.CodeActionOptions(code_action_kinds=code_actions.KINDS, resolve_provider=True),
        ),
        lsp.TEXT_DOCUMENT_CODE_LENS: DocumentRequest(_code_lenses),
        lsp.TEXT_DOCUMENT_INLAY_HINT: DocumentRequest(_inlay_hints),
        lsp.TEXT_DOCUMENT_FORMATTING: DocumentRequest(_formatting),
        lsp.TEXT_DOCUMENT_RANGE_FORMATTING: DocumentRequest(_range_formatting),
        lsp.TEXT_DOCUMENT_ON_TYPE_FORMATTING: DocumentRequest(
            _on_type,
            lsp.DocumentOnTypeFormattingOptions(
                first_trigger_character=formatting.TRIGGERS[0],
                more_trigger_character=formatting.TRIGGERS[1:],
            ),
        ),
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL: DocumentRequest(
            _tokens, token_pieces.LEGEND, is_long=True
        ),
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA: DocumentRequest(
            _token_delta, token_pieces.LEGEND, is_long=True
        ),
        lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE: DocumentRequest(
            _tokens_in_range, token_pieces.LEGEND
        ),
    }
)
"""Requests by method; completion has a file of its own, for the client decides its form."""
