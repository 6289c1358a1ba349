"""Ask the automaton what may come next, without building anything.

A stack is a list of states, deepest first. All of repair rests on `accepted`: how far the parse
would get if the next tokens were these.
"""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import ACCEPT, END

START = (0,)
"""The stack before the first token."""


def advance(stack: list[int], kind: str) -> bool:
    """Take one token, changing the stack; False leaves the stack as it was."""
    table = rapid_table()
    actions, rules, gotos = table.actions, table.rules, table.gotos
    # Reductions made before a token turns out to be wrong must not be kept: they depend on it.
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
    """Whether the parser would take all of these tokens, as far as the end of the text."""
    trial = list(stack)
    for kind in kinds:
        if not advance(trial, kind):
            return False
        if kind == END:
            break
    return True


def in_list(stack: Iterable[int]) -> bool:
    """Whether a statement, a declaration or a record component may begin here."""
    trial = list(stack)
    return advance(trial, "BROKEN") or advance(trial, "ENDRECORD")


def in_file(stack: Iterable[int]) -> bool:
    """Whether a module may begin here."""
    return advance(list(stack), "MODULE")
