"""Words of other robot languages, and what RAPID calls the same."""

from __future__ import annotations

from collections.abc import Mapping
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
    }
)
"""Folded words of other robot languages, and RAPID's routine for the same."""


def rapid_word_for(key: str) -> str | None:
    """RAPID's routine for a folded word of another robot language; None for other words."""
    return _OF_OTHER_LANGUAGES.get(key)
