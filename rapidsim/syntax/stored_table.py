"""Read the table of RAPID's grammar that `rapidsim.syntax.build_table` has stored.

A table that is missing or does not belong to the grammar is computed anew, which imports Lark;
otherwise Lark is never imported, which is what makes a small file quick to check.
"""

from __future__ import annotations

import json
from functools import cache

from rapidsim.shipped import shipped
from rapidsim.syntax.table import GRAMMAR_FILE, TABLE_FILE, Exported, Table, fingerprint, unpacked


@cache
def rapid_table() -> Table:
    """The table of RAPID."""
    folder = shipped("grammars")
    grammar = (folder / GRAMMAR_FILE).read_text(encoding="utf-8")
    stored = folder / TABLE_FILE
    if stored.is_file():
        exported: Exported = json.loads(stored.read_text(encoding="utf-8"))
        if exported["grammar"] == fingerprint(grammar):
            return unpacked(exported)
    # Only a developer who edits the grammar comes here, so only that developer pays for Lark.
    from rapidsim.syntax.build_table import export  # noqa: PLC0415

    return unpacked(export(grammar))
