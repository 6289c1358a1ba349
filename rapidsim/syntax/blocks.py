"""Match the words that open and close blocks, by token kind only."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from types import MappingProxyType

from rapidsim.values import value_class

CLOSERS = MappingProxyType(
    {
        "MODULE": "ENDMODULE",
        "RECORD": "ENDRECORD",
        "PROC": "ENDPROC",
        "FUNC": "ENDFUNC",
        "TRAP": "ENDTRAP",
        "IF": "ENDIF",
        "FOR": "ENDFOR",
        "WHILE": "ENDWHILE",
        "TEST": "ENDTEST",
    }
)
"""Closing word by kind of block."""
OPENERS = MappingProxyType({closer: opener for opener, closer in CLOSERS.items()})
"""Opening word by closing word."""
ROUTINES = frozenset({"PROC", "FUNC", "TRAP"})
DIVIDERS = MappingProxyType(
    {
        "ELSE": frozenset({"IF"}),
        "ELSEIF": frozenset({"IF"}),
        "CASE": frozenset({"TEST"}),
        "DEFAULT": frozenset({"TEST"}),
        "ERROR": ROUTINES,
        "UNDO": ROUTINES,
        "BACKWARD": frozenset({"PROC"}),
    }
)
"""Blocks that a dividing word may divide, by word."""
ITEMS = frozenset({"PROC", "FUNC", "TRAP", "RECORD", "ALIAS"})
"""Words that begin declarations that are invalid in a routine."""


@value_class(frozen=True, slots=True)
class OpenBlock:
    """An open block: the kind and the index of the token that opens it."""

    kind: str
    index: int
    dividers: tuple[int, ...] = ()
    """Indices of the ELSE, ELSEIF, CASE, DEFAULT or clause words in it."""


@value_class(frozen=True, slots=True)
class ClosedBlock:
    """A block, the index of the token that closes it, and the blocks open around it."""

    block: OpenBlock
    closer: int
    around: tuple[OpenBlock, ...]


@value_class(frozen=True, slots=True)
class Nesting:
    """The blocks that are open before a token."""

    blocks: tuple[OpenBlock, ...] = ()
    """Outermost first."""
    pending_if: int | None = None
    """Token of the IF whose condition or single statement contains the token."""


TOP = Nesting()
"""Nesting at the beginning of a module."""


def nesting(kinds: Sequence[str], start: int, stop: int, before: Nesting = TOP) -> Nesting:
    """Return the nesting before token `stop`, where that before token `start` is known."""
    blocks, pending_if = list(before.blocks), before.pending_if
    for index in range(start, stop):
        if _closes(kinds[index], blocks):
            blocks.pop()
        else:
            pending_if = _read(kinds[index], index, blocks, pending_if)
    return Nesting(tuple(blocks), pending_if)


def closed_blocks(
    kinds: Sequence[str], start: int, stop: int, around: Sequence[OpenBlock] = ()
) -> Iterator[ClosedBlock]:
    """Yield the blocks that tokens from `start` up to `stop` close, in that order.

    Args:
        kinds: The kinds of the tokens.
        start: The first token of a statement or declaration.
        stop: Index after the last token.
        around: The blocks that are open before `start`.
    """
    blocks, pending_if = list(around), None
    for index in range(start, stop):
        if _closes(kinds[index], blocks):
            block = blocks.pop()
            yield ClosedBlock(block, index, tuple(blocks))
        else:
            pending_if = _read(kinds[index], index, blocks, pending_if)


def _closes(kind: str, blocks: Sequence[OpenBlock]) -> bool:
    return kind in OPENERS and bool(blocks) and blocks[-1].kind == OPENERS[kind]


def _read(kind: str, index: int, blocks: list[OpenBlock], pending_if: int | None) -> int | None:
    """Note a word that opens or divides a block; return the IF that is pending after it."""
    # A THEN distinguishes a block IF from a compact one, unless an ELSEIF began its line.
    if kind == "IF":
        return index
    if kind == "THEN":
        if pending_if is not None:
            blocks.append(OpenBlock("IF", pending_if))
        return None
    if kind == "SEMICOLON":
        return None
    if kind in DIVIDERS:
        if blocks and blocks[-1].kind in DIVIDERS[kind]:
            blocks[-1] = replace(blocks[-1], dividers=(*blocks[-1].dividers, index))
        return None
    if kind in CLOSERS:
        blocks.append(OpenBlock(kind, index))
    return pending_if
