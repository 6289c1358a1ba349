"""The choice among the configurations that reach a target."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData
from rapidsim.motion.configurations.confdata import (
    NO_CONFIGURATION,
    Configuration,
    confdata_of,
    select,
    told_apart,
)
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.robot.robot import Robot

Quarters = tuple[int, int, int, int]
"""cf1, cf4, cf6, cfx."""

_EQUALLY_NEAR = 9
"""Decimal places of a distance [rad] that count."""
_MAIN_AXES = 0b110
"""The bits of cfx for the wrist centre: behind axis 1, behind the lower arm."""


def stored_or_nearest(
    working: Sequence[Configuration], stored: ConfData, near: Array
) -> Configuration:
    """The stored configuration if it works, else the nearest on its branch, else the nearest."""
    wanted = rounded(stored)
    for candidate in working:
        if candidate.confdata == wanted:
            return candidate
    same_branch = [candidate for candidate in working if candidate.confdata[3] == wanted[3]]
    return nearest(same_branch or working, near)


def by_stored(
    robot: Robot, base_from_flange: Transform, stored: Sequence[Quarters]
) -> list[list[Configuration]]:
    """The configurations that reach poses (k,), of each those first that are nearest to its stored.

    Nearest is the branch of cfx first, then the fewest quarter turns away, so it does not depend on
    where the arm comes from. Of each branch it is the turn nearest to what is stored, and the one
    in the middle of the range.
    """
    if not stored or not told_apart(robot.kinematics):
        return [[] for _ in stored]
    meant = np.array(stored)
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    found: list[dict[Quarters, Configuration]] = [{} for _ in stored]
    for branch in range(robot.kinematics.branch_count):
        wanted = meant.copy()
        wanted[:, 3] = branch
        selected = select(robot, base_from_flange, wanted, near)
        for joints in (selected.joints, turns_within_limits(robot, selected.joints)):
            within = selected.exists & ~limit_excess(robot, joints).any(axis=-1)
            named = confdata_of(robot.kinematics, joints)
            for at in np.flatnonzero(within).tolist():
                cf1, cf4, cf6, cfx = named[at].tolist()
                conf = (cf1, cf4, cf6, cfx)
                found[at].setdefault(conf, Configuration(joints[at], conf))
    return [
        [choices[conf] for conf in sorted(choices, key=lambda conf: _far(conf, of))]
        for choices, of in zip(found, stored, strict=True)
    ]


def _far(conf: Quarters, stored: Quarters) -> tuple[bool, int, Quarters]:
    """How far confdata is from the stored confdata, as a sort key."""
    quarters = sum(abs(a - b) for a, b in zip(conf[:3], stored[:3], strict=True))
    return conf[3] != stored[3], quarters, conf


def nearest_without_switch(working: Sequence[Configuration], start: Configuration) -> Configuration:
    r"""The nearest that leaves the main axes on their branch, else the nearest.

    Source: TRM, ConfJ \Off: the arm goes to the nearest configuration and does not switch that of
    its main axes. If only a switch reaches the target, it is made, and a run says so.
    """
    kept = [one for one in working if not is_switch(start, one)]
    return nearest(kept or working, start.joints)


def is_switch(start: Configuration, end: Configuration) -> bool:
    """Whether the main axes change to another branch."""
    return bool((start.confdata[3] ^ end.confdata[3]) & _MAIN_AXES)


def excess_without_switch(
    robot: Robot, base_from_flange: Transform, start: Configuration
) -> Array | None:
    """Joints (n,) [rad] past their limits that reach a pose without a switch of the main axes.

    Those that are past them by the least; None if the arm does not get there at all.
    """
    branches = robot.inverse(base_from_flange)
    kept = [
        number
        for number in np.flatnonzero(branches.exists).tolist()
        if not (number ^ start.confdata[3]) & _MAIN_AXES
    ]
    if not kept:
        return None
    joints = turns_within_limits(robot, branches.joints[kept])
    excess = np.abs(limit_excess(robot, joints)).max(axis=-1)
    least: Array = joints[int(excess.argmin())]
    return least


def nearest(working: Sequence[Configuration], near: Array) -> Configuration:
    """The configuration whose furthest-moving joint moves least."""
    return by_distance(working, near)[0]


def by_distance(working: Sequence[Configuration], near: Array) -> list[Configuration]:
    """Configurations, the nearest to joints (n,) [rad] first; those equally near as they come.

    Rounded, or the rounding of the machine would choose between turns that are equally far.
    """
    return sorted(
        working, key=lambda one: round(float(np.max(np.abs(one.joints - near))), _EQUALLY_NEAR)
    )


def rounded(conf: ConfData) -> Quarters:
    """Confdata as whole numbers."""
    return _whole(conf.cf1), _whole(conf.cf4), _whole(conf.cf6), _whole(conf.cfx)


def _whole(number: float) -> int:
    """A whole number; values no arm comes near, or none at all, name no configuration."""
    return round(number) if abs(number) < NO_CONFIGURATION else NO_CONFIGURATION


def conf_text(conf: Sequence[int]) -> str:
    """Confdata as RAPID writes it."""
    return f"[{','.join(map(str, conf))}]"
