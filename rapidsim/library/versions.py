r"""Since which RobotWare a name is known; what is not here, all versions have that anybody runs.

Until which one a name is known stands nowhere: no source lists what RobotWare 7 has no more.

A column of the library that stands by itself, because few names have one. An option is named with
its instruction, as `ReadStr\Status`.

Source: Technical reference manual RAPID Instructions, Functions and Data types, of RobotWare 6 and
of RobotWare 7.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rapidsim.language.robotware import RobotWare

_SEVEN = RobotWare(7)
_NAMES = (
    *("CONTINUE", "EGMWaitCond", r"EGMRunJoint\NoWaitCond", r"EGMRunPose\NoWaitCond", "Max"),
    *("Min", "MovePnP", r"ReadStr\Status", "StrFormat", "TriggAbsJ", "iconQuestion"),
)
SINCE: Mapping[str, RobotWare] = MappingProxyType({name.lower(): _SEVEN for name in _NAMES})
"""By folded name; a routine, an option of one, or data."""
