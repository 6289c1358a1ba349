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


def open_blocks(kinds: Sequence[str], start: int, stop: int) -> list[OpenBlock]:
    """Return the blocks that tokens from `start` up to `stop` leave open, outermost first."""
    blocks: list[OpenBlock] = []
    for _ in _walk(kinds, start, stop, blocks):
        pass
    return blocks


def closed_blocks(kinds: Sequence[str], start: int, stop: int) -> Iterator[ClosedBlock]:
    """Yield the closed blocks, in the order of their closing words."""
    return _walk(kinds, start, stop, [])


def _walk(
    kinds: Sequence[str], start: int, stop: int, blocks: list[OpenBlock]
) -> Iterator[ClosedBlock]:
    # A THEN distinguishes a block IF from a compact one, unless an ELSEIF began its line.
    pending_if: int | None = None
    for index in range(start, stop):
        kind = kinds[index]
        if kind == "IF":
            pending_if = index
        elif kind == "THEN":
            if pending_if is not None:
                blocks.append(OpenBlock("IF", pending_if))
                pending_if = None
        elif kind == "SEMICOLON":
            pending_if = None
        elif kind in DIVIDERS:
            pending_if = None
            if blocks and blocks[-1].kind in DIVIDERS[kind]:
                blocks[-1] = replace(blocks[-1], dividers=(*blocks[-1].dividers, index))
        elif kind in CLOSERS:
            blocks.append(OpenBlock(kind, index))
        elif kind in OPENERS and blocks and blocks[-1].kind == OPENERS[kind]:
            block = blocks.pop()
            yield ClosedBlock(block, index, tuple(blocks))
