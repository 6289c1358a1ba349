r"""Searching with the torch: Search_1D and Search_Groove.

The station file defines the positions of parts. The surface of a part at a taught search point is a
plane perpendicular to the direction of the search, and moves with the part. The torch stops exactly
on it.

Source: Application manual SmarTac (3HAC024845), "Search_1D": the search continues up to twice the
distance between its points; Result is the difference between the point found and the search point;
Speed applies up to the start point, and the search itself is made at 20 mm/s by default, subject to
the configuration. No available source documents what Search_Groove finds of the depth of a groove.
"""

from __future__ import annotations

from typing import Unpack

from rapidsim.frames import quaternion
from rapidsim.frames.vectors import dot, length, minus, plus, scaled
from rapidsim.language.annotations import InOut, Num, Pers, String, Switch
from rapidsim.language.controller import Controller
from rapidsim.language.data import (
    FINE,
    IDENTITY_POSE,
    Pos,
    Pose,
    RobTarget,
    SpeedData,
    ToolData,
)
from rapidsim.language.errors import NotAllowed
from rapidsim.language.moves import Interpolation
from rapidsim.library.displacement import in_object, in_program
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.motion import MoveOptions, build_move
from rapidsim.library.poses import composed, unit
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

INSTEAD = (
    "lines to the start point, to the search point and back; the part is where it was taught, "
    "unless [[search]] in the station file says where it is"
)
_GROOVE_INSTEAD = (
    "lines to the start point, to the centre and back; the groove is where it was taught, unless "
    "[[search]] in the station file says where it is; depth and width are as taught"
)
_ACROSS = "the displacement along the search; the depth and the width are as taught"
_KEPT = "the result is kept, as if the operator chose OK"
_SEARCH_SPEED = 20.0
"""Speed [mm/s] of the search."""
_FARTHEST = 2.0
"""Length of the search, as a multiple of the distance between its points."""
_LEAST_COSINE = 0.1
"""Cosine below which a surface is too oblique to the direction of the search to be hit."""


class TactileOptions(MoveOptions, total=False):
    """Options of a search with the torch in addition to those of moves."""

    not_off: Switch
    wire: Switch
    search_stop: InOut[RobTarget]
    pre_p_disp: Pose
    limit: Num
    search_name: String
    sch_speed: Num


def search_1d(
    controller: Controller,
    result: InOut[Pose],
    start_point: RobTarget,
    search_point: RobTarget,
    speed: SpeedData,
    tool: Pers[ToolData],
    **options: Unpack[TactileOptions],
) -> None:
    """Search a surface from one point towards another; the result is its displacement."""
    part = controller.searches.part_pose(options.get("search_name") or "")
    if part is None:
        controller.fidelity.not_simulated("Search_1D", INSTEAD)
    result.value = _search(
        controller, "Search_1D", part, start_point, search_point, speed, tool, options
    )


def search_groove(
    controller: Controller,
    result: InOut[Pose],
    groove_width: InOut[Num],
    start_point: RobTarget,
    cent_point: RobTarget,
    nom_width: Num,
    speed: SpeedData,
    tool: Pers[ToolData],
    **options: Unpack[TactileOptions],
) -> None:
    """Search the centre of a groove; the result is its displacement along the search."""
    part = controller.searches.part_pose(options.get("search_name") or "")
    controller.fidelity.not_simulated("Search_Groove", _GROOVE_INSTEAD if part is None else _ACROSS)
    result.value = _search(
        controller, "Search_Groove", part, start_point, cent_point, speed, tool, options
    )
    groove_width.value = nom_width


def _search(
    controller: Controller,
    name: str,
    part: Pose | None,
    start_point: RobTarget,
    search_point: RobTarget,
    speed: SpeedData,
    tool: Pers[ToolData],
    options: TactileOptions,
) -> Pose:
    """Move to the start point, to the surface and back; return the displacement found."""
    before = options.get("pre_p_disp") or IDENTITY_POSE
    start, towards = (_moved(before, point) for point in (start_point, search_point))
    found = towards
    if part is not None:
        found = _found(controller, name, part, (start_point, search_point), (start, towards))
    # Without a station entry the search takes the time of the programmed moves.
    slow = speed if part is None else speed._replace(v_tcp=_SEARCH_SPEED)
    for point, pace in ((start, speed), (found, slow), (start, speed)):
        move = build_move(controller, name, Interpolation.LINE, point, pace, FINE, tool, options)
        controller.motion.move(move)
    note_ignored_options(controller.fidelity, name, {r"\SchSpeed": options.get("sch_speed")})
    stop = options.get("search_stop")
    if stop is not None:
        stop.value = found
    turned = quaternion.rotate(unit(before.rot), search_point.trans)
    displaced = Pose(Pos(*minus(found.trans, turned)), before.rot)
    limit = options.get("limit")
    if limit is not None and length(displaced.trans) > limit:
        controller.fidelity.not_simulated(rf"{name} beyond its \Limit", _KEPT)
    return displaced


def _found(
    controller: Controller,
    name: str,
    part: Pose,
    taught: tuple[RobTarget, RobTarget],
    searched: tuple[RobTarget, RobTarget],
) -> RobTarget:
    """Point where a search meets the surface of a part, in program coordinates.

    Args:
        controller: Controller of the task.
        name: The instruction.
        part: Pose of the part in the work object in which it was taught.
        taught: Start point and search point as taught on the part.
        searched: Displaced points between which the torch searches.

    Raises:
        NotAllowed: If the surface is behind the start point or beyond the end of the search.
    """
    across = minus(taught[1].trans, taught[0].trans)
    start, towards = (in_object(controller.motion, point) for point in searched)
    ahead = minus(towards.trans, start.trans)
    distance = length(ahead)
    if not distance or not length(across):
        raise NotAllowed(f"{name}: the start point is the search point, so there is no direction")
    direction = scaled(ahead, 1.0 / distance)
    normal = quaternion.rotate(unit(part.rot), scaled(across, 1.0 / length(across)))
    surface = composed(part, Pose(taught[1].trans, taught[1].rot)).trans
    cosine = dot(direction, normal)
    way = dot(minus(surface, start.trans), normal) / cosine if cosine > _LEAST_COSINE else None
    if way is None or way > _FARTHEST * distance:
        told = "" if way is None else f". The part of the station is {way:.1f} mm away"
        raise NotAllowed(
            f"{name} finds nothing within {_FARTHEST * distance:.1f} mm, twice the distance "
            f"between its points; the controller asks the operator{told}"
        )
    if way < 0.0:
        raise NotAllowed(
            f"{name}: the torch touches the part at the start point, {-way:.1f} mm deep; the "
            "controller asks the operator. Begin farther away"
        )
    place = Pos(*plus(start.trans, scaled(direction, way)))
    return in_program(controller.motion, towards._replace(trans=place))


def _moved(displacement: Pose, point: RobTarget) -> RobTarget:
    if displacement == IDENTITY_POSE:
        return point
    pose = composed(displacement, Pose(point.trans, point.rot))
    return point._replace(trans=pose.trans, rot=pose.rot)


_OPTIONS = r"\WObj \PrePDisp \Limit \SearchName \TLoad \SchSpeed"

TACTILE_SEARCH = table(
    routine(
        "Search_1D",
        search_1d,
        rf"\NotOff \Wire Result \SearchStop StartPoint SearchPoint Speed Tool {_OPTIONS}",
        treated_as=INSTEAD,
        does=Trait.MOVE | Trait.CARTESIAN | Trait.SEARCH_PART,
    ),
    routine(
        "Search_Groove",
        search_groove,
        r"\NotOff \Wire Result \SearchStop GrooveWidth StartPoint CentPoint NomWidth Speed Tool "
        + _OPTIONS,
        treated_as=_GROOVE_INSTEAD,
        does=Trait.MOVE | Trait.CARTESIAN,
    ),
)
