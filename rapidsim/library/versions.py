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

_LATE_SIX = ("EGMWaitCond", r"EGMRunJoint\NoWaitCond", r"EGMRunPose\NoWaitCond", "StrFormat")
"""Manuals of RobotWare 6 lack them, but public programs that were made and tried on 6.14 use them;
since which version before there were any is not known."""
_SEVEN = ("CONTINUE", "Max", "Min", "MovePnP", r"ReadStr\Status", "TriggAbsJ", "iconQuestion")
SINCE: Mapping[str, RobotWare] = MappingProxyType(
    {
        **dict.fromkeys((name.lower() for name in _LATE_SIX), RobotWare(6, 14)),
        **dict.fromkeys((name.lower() for name in _SEVEN), RobotWare(7)),
    }
)
"""By folded name; a routine, an option of one, or data."""
