"""LALR recognizer: determine which tokens may follow, without building anything.

A stack is a list of states, deepest first. All repairs rely on `accepts`: whether the parse would
accept these tokens next.
"""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import ACCEPT, END

START = (0,)
"""The stack before the first token."""


def advance(stack: list[int], kind: str) -> bool:
    """Accept one token, changing the stack; False leaves the stack unchanged."""
    table = rapid_table()
    actions, rules, gotos = table.actions, table.rules, table.gotos
    # Reductions before a token that is then rejected must be undone: they depend on it.
    below = len(stack)
    pushed: list[int] = []
    while True:
        state = pushed[-1] if pushed else stack[below - 1]
        action = actions[state].get(kind)
        if action is None:
            return False
        if action >= ACCEPT:
            del stack[below:]
            stack += pushed
            if action > ACCEPT:
                stack.append(action - 1)
            return True
        rule = rules[-action - 1]
        length = rule.length
        if length <= len(pushed):
            del pushed[len(pushed) - length :]
        else:
            below -= length - len(pushed)
            pushed.clear()
        pushed.append(gotos[pushed[-1] if pushed else stack[below - 1]][rule.origin])


def accepts(stack: Iterable[int], kinds: Iterable[str]) -> bool:
    """Whether the parser would accept all of these tokens, up to the end of the text."""
    return rejected(stack, kinds) is None


def rejected(stack: Iterable[int], kinds: Iterable[str]) -> int | None:
    """Return the position of the first token that the parser would not accept; None for none."""
    trial = list(stack)
    for position, kind in enumerate(kinds):
        if not advance(trial, kind):
            return position
        if kind == END:
            break
    return None


def in_list(stack: Iterable[int]) -> bool:
    """Whether a statement, a declaration or a record component may begin here."""
    trial = list(stack)
    return advance(trial, "BROKEN") or advance(trial, "ENDRECORD")


def in_file(stack: Iterable[int]) -> bool:
    """Whether a module may begin here."""
    return advance(list(stack), "MODULE")
