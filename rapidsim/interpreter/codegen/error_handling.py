"""Statements under an ERROR clause: a small loop that retries or continues.

    _tries = 0
    while True:
        try:
            <statement>
        except _ERRORS as _e:
            _tries = _recover(ERROR, _e, _tries)
            if _tries:
                continue
        break

Retries are counted per statement: occasional retries over hours reach no limit.

Source: Technical reference manual RAPID Overview, "Error recovery": RETRY and TRYNEXT.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from rapidsim.interpreter.codegen.ast_builder import AstBuilder


def protected(
    body: Sequence[ast.stmt], at: AstBuilder, *, else_body: Sequence[ast.stmt] = ()
) -> list[ast.stmt]:
    """Wrap statements in such a loop; `else_body` runs when TRYNEXT skips them."""
    recovered = at.call("_recover", [at.name("ERROR"), at.name("_e"), at.name("_tries")])
    handler = [
        at.set("_tries", recovered),
        at.when(at.name("_tries"), [at.go_on()]),
        *else_body,
    ]
    return [
        at.set("_tries", at.constant(0)),
        at.forever([at.attempt(body, at.name("_ERRORS"), "_e", handler), at.stop()]),
    ]
