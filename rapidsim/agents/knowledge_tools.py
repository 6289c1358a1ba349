"""Tools that answer without a program: reach, explain, signature, search of the library."""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np

from rapidsim.agents.paging import Answer, paged
from rapidsim.diagnostics import all_rules
from rapidsim.files import InputError, did_you_mean
from rapidsim.jobs.inputs.selectors import unknown_rule
from rapidsim.language.data import Pose, RobTarget, ToolData, WobjData
from rapidsim.language.initial_values import initial_value
from rapidsim.language.types import Type
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.text import parsed_value
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.pose_solutions import solve_pose
from rapidsim.motion.robot.robot import RobotError, load_robot
from rapidsim.report.pages.library_page import signature_text
from rapidsim.report.pages.rules import explanation

T = TypeVar("T")


def reach(target: str, robot: str, tool: str = "tool0", wobj: str = "wobj0") -> Answer:
    """Whether an arm reaches a robtarget, and in which configurations.

    Args:
        target: A robtarget as RAPID writes it: `[[600,0,900],[1,0,0,0],[0,0,0,0],[9E9,...]]`.
        robot: Name of an arm.
        tool: `tool0`, or a tooldata as RAPID writes it.
        wobj: `wobj0`, or a wobjdata as RAPID writes it.

    Returns:
        `reachable`, `configurations` with `joints_deg` and `conf`, `reason` if there are none, with
        the mm that are short.

    Raises:
        InputError: If one of them cannot be read.
    """
    pose = _value("target", target, "robtarget", RobTarget)
    held = _value("tool", tool, "tooldata", ToolData)
    frame = _value("wobj", wobj, "wobjdata", WobjData)
    try:
        arm = load_robot(robot)
    except RobotError as error:
        raise InputError(str(error)) from None
    if not held.robhold or frame.robhold:
        raise InputError("a tool that stands still, or a work object that is held, needs a program")
    base_from_object = targets.transform(frame.uframe) @ targets.transform(frame.oframe)
    base_from_tcp = base_from_object @ targets.transform(Pose(pose.trans, pose.rot))
    base_from_flange = base_from_tcp @ targets.transform(held.tframe).inverse()
    found = solve_pose(arm, base_from_flange, everything=True)
    within = [one for one in found.solutions if one.within_limits]
    return {
        "robot": arm.name,
        "reachable": bool(within),
        "configurations": [
            {
                "joints_deg": np.degrees(one.joints).round(3).tolist(),
                "conf": list(one.confdata),
                "is_stored": list(one.confdata) == [math.floor(c) for c in pose.robconf],
            }
            for one in within
        ],
        "reason": found.reason,
    }


def explain(code: str) -> Answer:
    """Explain a rule: its code or name, severity, why it matters, an example.

    Raises:
        InputError: If there is no such rule.
    """
    rule = next((one for one in all_rules() if code.upper() == one.code or code == one.name), None)
    if rule is None:
        raise unknown_rule(code)
    return {
        "code": rule.code,
        "name": rule.name,
        "severity": rule.severity.value,
        "explanation": explanation(rule),
    }


def signature(name: str) -> Answer:
    """The signature of an instruction or function of RAPID.

    Raises:
        InputError: If RAPID has none of this name.
    """
    row = ROUTINES.get(name.lower())
    if row is None:
        known = [one.name for one in ROUTINES.values()]
        raise InputError(f"RAPID has no routine `{name}`", did_you_mean(name, known))
    return {"name": row.name, "signature": signature_text(row), "simulated": row.simulated}


def search_library(words: str, cursor: int = 0) -> Answer:
    """Instructions and functions whose names or signatures contain all of some words.

    Returns:
        `routines` with name, signature and whether they are simulated; `next_cursor`.
    """
    wanted = words.lower().split()
    found = []
    for row in sorted(ROUTINES.values(), key=lambda one: one.name.lower()):
        text = signature_text(row)
        if wanted and all(word in text.lower() for word in wanted):
            # Names count before parameters.
            rank = not all(word in row.name.lower() for word in wanted)
            found.append((rank, {"name": row.name, "signature": text, "simulated": row.simulated}))
    ordered = [entry for _, entry in sorted(found, key=lambda one: (one[0], one[1]["name"]))]
    return paged({"count": len(ordered), "routines": ordered}, ("routines",), cursor)


def _value(subject: str, text: str, type_name: str, of: type[T]) -> T:
    known = DATA.get(text.strip().lower())
    if known is not None and isinstance(known.value, of):
        return known.value
    kind: Type = TYPES[type_name]
    value = parsed_value(text.strip(), kind, initial_value(kind))
    if not isinstance(value, of):
        raise InputError(f"`{subject}` is no {type_name}: `{text}`")
    return value
