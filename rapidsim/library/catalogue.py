"""All installed routines: the chapters of the library, and those that are declared only.

The list of declared routines is read when a name is asked for that no chapter has.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Mapping
from types import MappingProxyType

from rapidsim.library.bits import BITS
from rapidsim.library.mathematics import MATHEMATICS
from rapidsim.library.strings import STRINGS
from rapidsim.library.table import LibraryRoutine

SIMULATED: Mapping[str, LibraryRoutine] = MappingProxyType(
    dict(ChainMap(*map(dict, (MATHEMATICS, BITS, STRINGS))))
)
ROUTINES: Mapping[str, LibraryRoutine] = SIMULATED
"""Every installed routine by folded name."""
