"""The choice among the configurations that reach a target."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.findings.reach_and_motion_data import (
    ConfigurationNotReachable,
    PastLimitByRounding,
)
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData
from rapidsim.motion.configurations.compliance import Match, hold
from rapidsim.motion.configurations.confdata import (
    NO_CONFIGURATION,
    QUARTER,
    Configuration,
    confdata_of,
    has_branches,
    select,
)
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    pose_excess,
    turns_within_limits,
)
from rapidsim.motion.robot.robot import Robot

Quarters = tuple[int, int, int, int]
"""cf1, cf4, cf6, cfx."""

_EQUALLY_NEAR = 9
"""Number of decimal places of a distance [rad] that are compared."""
_LEAST_EXCESS = np.radians(1e-3)
"""Minimum excess [rad] that is reported."""
_ROUNDED = 0.01
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
    """The configurations that reach poses (k,), for each pose nearest to its stored one first.

    Nearest is the branch of cfx first, then the fewest quarter turns away, so it does not depend on
    the start of the arm. For each branch the turns are those nearest to the stored ones, and those
    in the middle of the range.
    """
    if not stored or not has_branches(robot.kinematics):
        return [[] for _ in stored]
    meant = np.array(stored)
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    found: list[dict[Quarters, Configuration]] = [{} for _ in stored]
    for branch in range(robot.kinematics.branch_count):
        wanted = meant.copy()
        wanted[:, 3] = branch
        selected = select(robot, base_from_flange, wanted, near)
        for joints in (selected.joints, turns_within_limits(robot, selected.joints)):
            within = selected.exists & ~pose_excess(robot, joints).any(axis=-1)
            named = confdata_of(robot.kinematics, joints)
            for at in np.flatnonzero(within).tolist():
                cf1, cf4, cf6, cfx = named[at].tolist()
                conf = (cf1, cf4, cf6, cfx)
                found[at].setdefault(conf, Configuration(joints[at], conf))
    return [
        [choices[conf] for conf in sorted(choices, key=lambda conf: _far(conf, of))]
        for choices, of in zip(found, stored, strict=True)
    ]


def not_as_stored(
    robot: Robot,
    base_from_flange: Transform,
    stored: Sequence[Quarters],
    targets: Sequence[str],
) -> list[ConfigurationNotReachable]:
    """Findings for stored configurations that the arm cannot take, of targets with poses (k,).

    The list of working configurations is empty for poses that no configuration reaches.
    """
    working = by_stored(robot, base_from_flange, stored)
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    best = hold(robot, base_from_flange, np.array(stored).reshape(-1, 4), near)
    excess = np.where((best.match < Match.TURNED)[:, None], best.excess, 0.0)
    found = []
    for row, (choices, target) in enumerate(zip(working, targets, strict=True)):
        listed = tuple(conf_text(one.confdata) for one in choices)
        axis = int(np.abs(excess[row]).argmax())
        over = abs(float(excess[row, axis]))
        past_limit = ""
        if 0.0 < over < QUARTER:
            conf = conf_text(confdata_of(robot.kinematics, best.joints[row]).tolist())
            past_limit = (
                f"in {conf} joint {axis + 1} would be at "
                f"{robot.axes.text(axis, best.joints[row, axis])}, "
                f"{robot.axes.text(axis, over)} past its limit"
            )
        taken = listed[0] if listed else ""
        found.append(
            ConfigurationNotReachable(target, conf_text(stored[row]), taken, listed, past_limit)
        )
    return found


def replacement_finding(
    target: str, stored: Quarters, chosen: Configuration, working: Sequence[Configuration]
) -> ConfigurationNotReachable:
    """Finding for a run that continues with other turns of the stored branch, with alternatives."""
    named = conf_text(chosen.confdata)
    others = [text for one in working if (text := conf_text(one.confdata)) != named]
    return ConfigurationNotReachable(
        target, conf_text(stored), named, (named, *others), continues=True
    )


def past_limit(robot: Robot, target: str, joints: Array) -> PastLimitByRounding | None:
    """Finding for the joint furthest past its limit at a target, within the tolerance there.

    None if no joint is, or by less than a thousandth of a degree.
    """
    excess = np.abs(limit_excess(robot, joints))
    axis = int(excess.argmax())
    if not excess[axis] > _LEAST_EXCESS or robot.kinematics.slides[axis]:
        return None
    over, at = np.degrees([excess[axis], joints[axis]]).tolist()
    digits = 2 if over >= _ROUNDED else 3
    conf = conf_text(confdata_of(robot.kinematics, joints).tolist())
    return PastLimitByRounding(
        target, conf, axis + 1, f"{at:.{digits}f} deg", f"{over:.{digits}f} deg"
    )


def _far(conf: Quarters, stored: Quarters) -> tuple[bool, int, Quarters]:
    """Distance of confdata from the stored confdata, as a sort key."""
    quarters = sum(abs(a - b) for a, b in zip(conf[:3], stored[:3], strict=True))
    return conf[3] != stored[3], quarters, conf


def nearest_without_switch(working: Sequence[Configuration], start: Configuration) -> Configuration:
    r"""The nearest that keeps the main axes on their branch, else the nearest.

    Source: TRM, ConfJ \Off: the arm moves to the nearest configuration without switching that of
    its main axes. If only a switch reaches the target, it is made, and a run reports it.
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

    The solution with the least excess; None if the arm does not reach the pose at all.
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
    excess = np.abs(pose_excess(robot, joints)).max(axis=-1)
    least: Array = joints[int(excess.argmin())]
    return least


def nearest(working: Sequence[Configuration], near: Array) -> Configuration:
    """The configuration whose furthest-moving joint moves least."""
    return by_distance(working, near)[0]


def by_distance(working: Sequence[Configuration], near: Array) -> list[Configuration]:
    """Configurations, the nearest to joints (n,) [rad] first; ties keep their order.

    Distances are rounded; otherwise rounding errors would choose between equally distant turns.
    """
    return sorted(
        working, key=lambda one: round(float(np.max(np.abs(one.joints - near))), _EQUALLY_NEAR)
    )


def rounded(conf: ConfData) -> Quarters:
    """Confdata as whole numbers."""
    return _whole(conf.cf1), _whole(conf.cf4), _whole(conf.cf6), _whole(conf.cfx)


def _whole(number: float) -> int:
    """A whole number; out-of-range and non-finite values map to one that names no configuration."""
    return round(number) if abs(number) < NO_CONFIGURATION else NO_CONFIGURATION


def conf_text(conf: Sequence[int]) -> str:
    """Confdata in RAPID syntax."""
    return f"[{','.join(map(str, conf))}]"
