"""Blocks of RAPID that completion inserts whole."""

from __future__ import annotations

from lsprotocol import types as lsp

from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Snippet:
    """A block with its places to fill in."""

    word: str
    text: str
    is_of_routine: bool = True
    """Whether it belongs into a routine, not around it."""

    def item(self, sort: str) -> lsp.CompletionItem:
        """Return the block as an item."""
        return lsp.CompletionItem(
            label=f"{self.word} ...",
            kind=lsp.CompletionItemKind.Snippet,
            filter_text=self.word,
            insert_text=self.text,
            insert_text_format=lsp.InsertTextFormat.Snippet,
            insert_text_mode=lsp.InsertTextMode.AdjustIndentation,
            sort_text=f"{sort}{self.word.lower()}",
        )


BLOCKS = (
    Snippet("IF", "IF ${1:condition} THEN\n    $0\nENDIF"),
    Snippet("FOR", "FOR ${1:i} FROM ${2:1} TO ${3:10} DO\n    $0\nENDFOR"),
    Snippet("WHILE", "WHILE ${1:condition} DO\n    $0\nENDWHILE"),
    Snippet("TEST", "TEST ${1:number}\nCASE ${2:1}:\n    $0\nDEFAULT:\nENDTEST"),
    Snippet("ERROR", "ERROR\n    IF ERRNO=${1:ERR_NAME} THEN\n        $0\n    ENDIF"),
    Snippet("PROC", "PROC ${1:name}()\n    $0\nENDPROC", is_of_routine=False),
    Snippet("FUNC", "FUNC ${1:num} ${2:name}(${3:num x})\n    RETURN ${4:x};\nENDFUNC", False),
    Snippet("TRAP", "TRAP ${1:name}\n    $0\nENDTRAP", is_of_routine=False),
    Snippet("RECORD", "RECORD ${1:name}\n    ${2:num} ${3:x};\nENDRECORD", False),
    Snippet("MODULE", "MODULE ${1:name}\n    $0\nENDMODULE", is_of_routine=False),
)
