"""Signals that a controller makes itself, so that its I/O configuration (`EIO.cfg`) lacks them.

They show the states of the panel board, the drive modules, the safety controller and the conveyor
tracking modules.

Source: the signals that Robot Web Services list on an IRC5 with conveyor tracking; those of the
safety controller from programs for it, and from the file with its configuration (`sc_cfg.xml`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.language.types import (
    SIGNAL_AI,
    SIGNAL_AO,
    SIGNAL_DI,
    SIGNAL_DO,
    SIGNAL_GI,
    SIGNAL_GO,
    Type,
)

_PANEL: Final = (
    (
        SIGNAL_DI,
        "AS1 AS2 AUTO1 AUTO2 CH1 CH2 DRVOVLD EN1 EN2 ENABLE1 ENABLE2_1 ENABLE2_2 ENABLE2_3"
        " ENABLE2_4 ES1 ES2 GS1 GS2 MAN1 MAN2 MANFS1 MANFS2 MONPB PANEL24OVLD PANFAN SOFTASI"
        " SOFTESI SOFTGSI SOFTSSI SS1 SS2 USERDOOVLD",
    ),
    (
        SIGNAL_DO,
        "MOTLMP SOFTASO SOFTESO SOFTGSO SOFTSSO STLEDGR STLEDGRBNK STLEDRED STLEDREDBNK TESTEN1",
    ),
)
_SAFETY: Final = (
    (
        SIGNAL_DI,
        "AutomaticMode DriveEnable DriveEnableFeedback ExternalPowerControlActive"
        " ExternalPowerControlFeedback LocalEmergencyStopStatus ManualFullSpeedMode ManualMode"
        " SafetyEnable",
    ),
    (SIGNAL_DO, "SC#CBCERR SC#CBCOK SC#CBCPREWARN SC#CBCREQ SC#CBCWAR"),
)
_DRIVES: Final = (
    (
        SIGNAL_DI,
        "DRV#BRAKEFB DRV#BRAKEOK DRV#EXTCONT DRV#FAN1 DRV#FAN2 DRV#K1 DRV#K2 DRV#LIM1 DRV#LIM2"
        " DRV#PANCH1 DRV#PANCH2 DRV#PTCEXT DRV#PTCINT DRV#SPEED DRV#TEST1 DRV#TEST2",
    ),
    (SIGNAL_DO, "DRV#BRAKE DRV#CHAIN1 DRV#CHAIN2 DRV#TESTE2"),
)
_CONVEYORS: Final = (
    (SIGNAL_AI, "c#CountsPerSec"),
    (SIGNAL_AO, "c#Position c#Speed"),
    (SIGNAL_GI, "c#CntFromEnc c#Counts c#SpeedBandWidth"),
    (SIGNAL_GO, "c#CntToEnc c#ObjectsInQ c#TrigAutoDist c#TrigAutoEncNo"),
    (
        SIGNAL_DO,
        "c#CntToEncStr c#Connected c#DropWObj c#NewObjStrobe c#NullSpeed c#PassStw c#PosInJobQ"
        " c#Rem1PObj c#RemAllPObj c#SoftSync c#TrigAutoMode c#TrigVis c#WaitWObj",
    ),
)
_KINDS: Final[Mapping[str, Type]] = MappingProxyType(
    {
        name: kind
        for part in (_PANEL, _SAFETY, _DRIVES, _CONVEYORS)
        for kind, names in part
        for name in names.split()
    }
)
"""Kinds by name; `#` is the number of the drive module, safety controller or conveyor."""
_NUMBER: Final = re.compile(r"(?<=^c)\d|(?<=^SC)\d|(?<=^DRV)\d")


def system_signal(name: str) -> Type | None:
    """Return the kind of a signal that controllers make themselves; None if none has this name.

    Args:
        name: The name as controllers spell it: short ones in another case are rather misspelt data.
    """
    return _KINDS.get(_NUMBER.sub("#", name))
