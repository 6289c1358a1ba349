"""Words of other robot languages or similar to RAPID's, with the corresponding RAPID words."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from types import MappingProxyType

_OF_OTHER_LANGUAGES: Mapping[str, str] = MappingProxyType(
    {
        # KUKA
        **dict.fromkeys(("ptp", "sptp", "ptp_rel"), "MoveJ"),
        **dict.fromkeys(("lin", "slin", "lin_rel"), "MoveL"),
        **dict.fromkeys(("circ", "scirc"), "MoveC"),
        "halt": "Stop",
        # Universal Robots
        **dict.fromkeys(("movep", "move_linear"), "MoveL"),
        **dict.fromkeys(("sleep", "delay", "wait", "pause", "dwell"), "WaitTime"),
        **dict.fromkeys(("popup", "msgbox"), "UIMsgBox"),
        **dict.fromkeys(("textmsg", "print", "printf", "writeln"), "TPWrite"),
        **dict.fromkeys(("set_digital_out", "set_standard_digital_out"), "SetDO"),
        **dict.fromkeys(("set_analog_out", "set_standard_analog_out"), "SetAO"),
        **dict.fromkeys(("stopj", "stopl"), "StopMove"),
        **dict.fromkeys(("get_digital_in", "get_standard_digital_in"), "DInput"),
        "get_actual_tcp_pose": "CRobT",
        "get_actual_joint_positions": "CJointT",
        "get_inverse_kin": "CalcJointT",
        "get_forward_kin": "CalcRobT",
        "pose_trans": "PoseMult",
        "pose_inv": "PoseInv",
        "to_str": "ValToStr",
        "str": "ValToStr",
        # Words that RAPID might have had
        **dict.fromkeys(("moveptp", "movejoint", "movejoints"), "MoveJ"),
        **dict.fromkeys(("movelin", "movelinear", "moveline"), "MoveL"),
        **dict.fromkeys(("movecirc", "movecircular", "movearc"), "MoveC"),
        **dict.fromkeys(("setdigitalout", "setdigitaloutput", "setoutput"), "SetDO"),
        **dict.fromkeys(("setanalogout", "setanalogoutput"), "SetAO"),
        **dict.fromkeys(("setgroupout", "setgroupoutput"), "SetGO"),
        **dict.fromkeys(("waitdigital", "waitinput", "waitdigitalinput"), "WaitDI"),
        **dict.fromkeys(("waitsec", "waitseconds", "waitms"), "WaitTime"),
        **dict.fromkeys(("tpwriteline", "tpprint", "writeline"), "TPWrite"),
        **dict.fromkeys(("length", "len", "strlength"), "StrLen"),
        **dict.fromkeys(("substr", "substring"), "StrPart"),
        **dict.fromkeys(("inttostr", "numtostring", "tostring"), "NumToStr"),
        **dict.fromkeys(("sqroot", "squareroot"), "Sqrt"),
        "resetdo": "Reset",
        "currentpos": "CRobT",
    }
)
"""Corresponding RAPID routine by folded word."""


def rapid_word_for(key: str) -> str | None:
    """Return RAPID's routine for a folded foreign word; None if unknown."""
    return _OF_OTHER_LANGUAGES.get(key)


_OPTIONS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        **dict.fromkeys(("workobj", "workobject", "wobject", "frame", "base"), ("wobj",)),
        **dict.fromkeys(("timeout", "maxwait", "maximumtime"), ("maxtime",)),
        **dict.fromkeys(("inposition", "inpos", "fine"), ("inpos",)),
        **dict.fromkeys(("load", "payload", "toolload"), ("tload",)),
        **dict.fromkeys(("velocity", "speed", "vel"), ("v", "speed")),
        **dict.fromkeys(("duration", "seconds"), ("t", "time")),
        **dict.fromkeys(("delay", "wait"), ("sdelay",)),
        **dict.fromkeys(("number", "value"), ("num",)),
        **dict.fromkeys(("length", "pulse", "width"), ("plength",)),
        **dict.fromkeys(("concurrent", "async", "asynchronous"), ("conc",)),
    }
)
"""Folded options that may be intended, by folded word."""


def option_for(key: str, names: Collection[str]) -> str | None:
    r"""Return the option of a routine for a folded foreign word, such as `\WObj`; else None.

    Args:
        key: The word.
        names: The options of the routine.
    """
    meant = _OPTIONS.get(key, ())
    return next((one for one in names if one.lstrip("\\").lower() in meant), None)
