"""Which of the configurations that reach a target is taken."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.language.data import ConfData
from rapidsim.motion.configurations.confdata import Configuration

Quarters = tuple[int, int, int, int]
"""cf1, cf4, cf6, cfx."""

_EQUALLY_NEAR = 9
"""Digits of a distance [rad] that count."""
_MAIN_AXES = 0b110
"""The bits of cfx for the wrist centre: behind axis 1 or not, behind the lower arm or not."""


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


def nearest_without_switch(working: Sequence[Configuration], start: Configuration) -> Configuration:
    r"""The nearest that leaves the main axes on their branch, else the nearest.

    Source: TRM, ConfJ \Off: the arm goes to the nearest configuration and does not switch that of
    its main axes. Where only a switch reaches the target, it is made.
    """
    main_axes = start.confdata[3] & _MAIN_AXES
    kept = [one for one in working if one.confdata[3] & _MAIN_AXES == main_axes]
    return nearest(kept or working, start.joints)


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
    """The whole numbers of confdata."""
    return round(conf.cf1), round(conf.cf4), round(conf.cf6), round(conf.cfx)


def conf_text(conf: Quarters) -> str:
    """Confdata as RAPID writes it."""
    return f"[{','.join(map(str, conf))}]"
