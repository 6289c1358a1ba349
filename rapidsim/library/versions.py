r"""First RobotWare version of names; names that are absent exist in all versions in use.

The last version of a name is not recorded: no source lists what RobotWare 7 removed.

This column of the library is a separate table, because few names need it. An option is named with
its instruction, as `ReadStr\Status`.

Source: Technical reference manual RAPID Instructions, Functions and Data types, of RobotWare 6 and
of RobotWare 7.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rapidsim.language.robotware import RobotWare

_LATE_SIX = ("EGMWaitCond", r"EGMRunJoint\NoWaitCond", r"EGMRunPose\NoWaitCond", "StrFormat")
"""Names that the manuals of RobotWare 6 lack, but that public programs written and tested for 6.14
use; their first version is unknown.
"""
_SEVEN = ("CONTINUE", "Max", "Min", "MovePnP", r"ReadStr\Status", "TriggAbsJ", "iconQuestion")
SINCE: Mapping[str, RobotWare] = MappingProxyType(
    {
        **dict.fromkeys((name.lower() for name in _LATE_SIX), RobotWare(6, 14)),
        **dict.fromkeys((name.lower() for name in _SEVEN), RobotWare(7)),
    }
)
"""First version by folded name of a routine, an option or data."""
