"""Units of length of drawings."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, TypeAlias

from rapidsim.json_records.declarations import noun


class LengthUnit(StrEnum):
    """A unit of length."""

    MILLIMETRE = "mm"
    CENTIMETRE = "cm"
    METRE = "m"
    INCH = "inch"

    @property
    def in_m(self) -> float:
        """Its length [m]."""
        return _LENGTHS_M[self]


_LENGTHS_M = {
    LengthUnit.MILLIMETRE: 1e-3,
    LengthUnit.CENTIMETRE: 1e-2,
    LengthUnit.METRE: 1.0,
    LengthUnit.INCH: 0.0254,
}
UnitKey: TypeAlias = Annotated[LengthUnit | None, noun("a unit of length", folds_case=False)]
"""A key whose value is a unit of length."""
