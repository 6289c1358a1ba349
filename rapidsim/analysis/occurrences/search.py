"""All names of a task that refer to one symbol.

The text is searched for the name, and each match is resolved by the nodes around it. So the time
grows with the number of matches, and no index has to follow the changes of a text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from rapidsim.analysis.occurrences.locate import name_at
from rapidsim.analysis.occurrences.names import NamesOfNodes, Occurrence
from rapidsim.analysis.occurrences.symbols import InstalledParameterSymbol, NamedSymbol
from rapidsim.syntax import tree


def occurrences(
    symbol: NamedSymbol, names: NamesOfNodes, files: tuple[tree.File, ...] | None = None
) -> Iterator[Occurrence]:
    """Yield the names that refer to a symbol, in the order of the files and of the text.

    Args:
        symbol: Any symbol, also a predefined one.
        names: Resolves the names of the task.
        files: The files to search; None for all of the task.
    """
    spellings = {symbol.name.lower()}
    if isinstance(symbol, InstalledParameterSymbol) and symbol.parameter.also:
        spellings.add(symbol.parameter.also.lower())
    for file in names.facts.files if files is None else files:
        for key in spellings:
            for found in names_spelled(key, file, names):
                if found.symbol == symbol:
                    yield found


def names_spelled(key: str, file: tree.File, names: NamesOfNodes) -> Iterator[Occurrence]:
    """Yield the names of a file with a spelling, whatever they refer to."""
    source = file.source
    for match in word_pattern(key).finditer(source.written.text):
        found = name_at(file, source.address(match.start()), names)
        if found is not None and found.name.key == key:
            yield found


@lru_cache(maxsize=64)
def word_pattern(key: str) -> re.Pattern[str]:
    """Return the pattern of a name as a whole word, in any case."""
    return re.compile(rf"(?<!\w){re.escape(key)}(?!\w)", re.IGNORECASE)
