"""Numbers with their units, which stay together where lines are broken."""

from __future__ import annotations

import re

_QUANTITY = re.compile(r"(?<=\d) (?=(?:s|ms|mm|mm/s|mm2|deg|deg/s|%|kg)\b|%)")
_JOINT = "\ue000"
"""Stands for the space while lines are broken; no text has it, for it means nothing."""


def joined(text: str) -> str:
    """The text with no space between a number and its unit; as long as before."""
    return _QUANTITY.sub(_JOINT, text)


def parted(text: str) -> str:
    """The text, or a line of it, as it was before `joined`."""
    return text.replace(_JOINT, " ")
