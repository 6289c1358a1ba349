"""Read the table of RAPID's grammar that `rapidsim.syntax.build_table` has stored.

A table that is missing or does not belong to the grammar is computed again, which imports Lark;
otherwise Lark is never imported, which keeps the check of a small file quick.
"""

from __future__ import annotations

import json
from functools import cache

from rapidsim.shipped import shipped
from rapidsim.syntax.table import GRAMMAR_FILE, TABLE_FILE, Exported, Table, fingerprint, unpacked


@cache
def rapid_table() -> Table:
    """Return the LALR table of RAPID."""
    folder = shipped("grammars")
    grammar = (folder / GRAMMAR_FILE).read_text(encoding="utf-8")
    stored = folder / TABLE_FILE
    if stored.is_file():
        exported: Exported = json.loads(stored.read_text(encoding="utf-8"))
        if exported["grammar"] == fingerprint(grammar):
            return unpacked(exported)
    # Only developers who edit the grammar reach this, so only they pay for Lark.
    from rapidsim.syntax.build_table import export  # noqa: PLC0415

    return unpacked(export(grammar))
