r"""Searching with the torch: Search_1D goes its way and finds the part where it was taught.

Source: Application manual SmarTac, "Search_1D".
"""

from __future__ import annotations

from typing import Unpack

from rapidsim.language.annotations import InOut, Num, Pers, String, Switch
from rapidsim.language.controller import Controller
from rapidsim.language.data import FINE, IDENTITY_POSE, Pose, RobTarget, SpeedData, ToolData
from rapidsim.language.moves import Interpolation
from rapidsim.library.motion import MoveOptions, asked
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Does

INSTEAD = "lines to the start point, to the search point and back; the part is where it was taught"


class TactileOptions(MoveOptions, total=False):
    """What a search with the torch may have beside what moves have."""

    not_off: Switch
    search_stop: InOut[RobTarget]
    pre_p_disp: Pose
    limit: Num
    search_name: String


def search_1d(
    controller: Controller,
    result: InOut[Pose],
    start_point: RobTarget,
    search_point: RobTarget,
    speed: SpeedData,
    tool: Pers[ToolData],
    **options: Unpack[TactileOptions],
) -> None:
    """Go to a point and on to another one, and tell how far the part is displaced: not at all."""
    controller.honesty.not_simulated("Search_1D", INSTEAD)
    for point in (start_point, search_point, start_point):
        move = asked(controller, "Search_1D", Interpolation.LINE, point, speed, FINE, tool, options)
        controller.motion.move(move)
    stop = options.get("search_stop")
    if stop is not None:
        stop.value = search_point
    result.value = options.get("pre_p_disp") or IDENTITY_POSE


TACTILE_SEARCH = table(
    routine(
        "Search_1D",
        search_1d,
        r"\NotOff Result \SearchStop StartPoint SearchPoint Speed Tool \WObj \PrePDisp \Limit "
        r"\SearchName \TLoad",
        treated_as=INSTEAD,
        does=Does.MOVE | Does.CARTESIAN,
    ),
)
