"""Work objects: user frame, object frame, and a faint plate in the object's plane.

The world is not a work object here: `wobj0` has no frames to show.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import rerun as rr

from rapidsim.controller.moves.executed_moves import MoveColumns
from rapidsim.frames.transform import Array
from rapidsim.language.data import IDENTITY_POSE, WobjData
from rapidsim.language.moves import Place
from rapidsim.motion.configurations.targets import base_from_object
from rapidsim.recording import palette
from rapidsim.recording.frame_changes import changes, stacked
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.arm import FLANGE
from rapidsim.recording.scene.tool import TCP
from rapidsim.recording.transforms import BASE, WORLD, moving_frame

ENTITY = "work_objects"

_THICKNESS = 0.002
_SMALLEST = 0.05
"""Half the side [m] of the smallest plate."""


def log_work_objects(
    stream: rr.RecordingStream, run: RecordedRobot, axis_m: float
) -> tuple[str, ...]:
    """Log the frames of the work objects with axes of a length [m].

    Returns:
        Remarks on content that the viewer cannot show correctly, one per line.
    """
    for name, rows in _by_name(run.robot_run.moves.columns).items():
        _log_frames(stream, run, name, rows, axis_m)
        _log_plate(stream, run, name, rows)
    moved = dict.fromkeys(
        move.wobj.ufmec for move in run.robot_run.moves.columns.templates if not move.wobj.ufprog
    )
    return tuple(f"work objects moved by `{unit}` are shown with it at zero" for unit in moved)


def _log_frames(
    stream: rr.RecordingStream,
    run: RecordedRobot,
    name: str,
    rows: Sequence[int],
    axis_m: float,
) -> None:
    """Log user frame and object frame; on the flange for a work object that the robot holds."""
    object_frame, flange = run.frame(name), run.frame(FLANGE)
    user_frame = f"{object_frame}.uframe"
    programmed = run.robot_run.moves.columns.templates
    moves = [
        run.robot_run.moves[row]
        for before, row in pairwise([-1, *rows])
        if before < 0 or programmed[row].wobj is not programmed[before].wobj
    ]
    users = changes(
        moves,
        lambda move: move.move.wobj.uframe,
        lambda move: flange if move.move.wobj.robhold else WORLD,
    )
    objects = changes(moves, lambda move: move.move.wobj.oframe, lambda _: user_frame)
    for entity, child, values in (("user", user_frame, users), ("object", object_frame, objects)):
        path = _entity(run, name, entity)
        parents = [change.parent for change in values]
        stream.send_columns(
            path,
            indexes=run.clock.columns([change.time_s for change in values]),
            columns=moving_frame(parents, child, stacked(values)),
        )
        stream.log(
            path,
            rr.CoordinateFrame(child),
            rr.TransformAxes3D(axis_m if child == object_frame else 0.6 * axis_m),
            static=True,
        )


def object_origins(run: RecordedRobot) -> Array:
    """Return the origins of the object frames (k, 3) [m] in the base."""
    columns = run.robot_run.moves.columns
    used = dict.fromkeys(
        columns.templates[row].wobj
        for rows in _by_name(columns).values()
        for row in rows
        if not columns.templates[row].wobj.robhold
    )
    base_from_world = run.robot_run.world_from_base.inverse()
    origins = [base_from_object(wobj, base_from_world).translation for wobj in used]
    return np.array(origins).reshape(-1, 3)


def _entity(run: RecordedRobot, name: str, part: str) -> str:
    """Return the entity of part of a work object; the name may be an expression (`wobjs{1}`)."""
    return run.entity(rr.new_entity_path([ENTITY, name, part]).removeprefix("/"))


def _by_name(columns: MoveColumns) -> dict[str, list[int]]:
    """Return the rows of moves that use a work object other than the world, by its name."""
    found: dict[str, list[int]] = {}
    last, name = None, None
    for row, move in enumerate(columns.templates):
        if move is not last:
            last, wobj = move, move.wobj
            is_world = wobj.uframe == IDENTITY_POSE and wobj.oframe == IDENTITY_POSE
            name = None if is_world else _name(columns.places[row])
        if name is not None:
            found.setdefault(name, []).append(row)
    return found


def _name(place: Place) -> str:
    name = " ".join(place.arguments.get("wobj", "wobj").split())
    return f"{name} (wobj)" if name in (WORLD, BASE, FLANGE, TCP) else name


def _log_plate(
    stream: rr.RecordingStream, run: RecordedRobot, name: str, rows: Sequence[int]
) -> None:
    """Log a named plate under the targets and the origin, in the plane of the object frame."""
    columns = run.robot_run.moves.columns
    end_m = columns.end_m
    places: dict[WobjData, list[Array]] = {}
    for row in rows:
        move = columns.templates[row]
        if not move.wobj.robhold and move.wobj.ufprog and move.tool.robhold:
            place = (
                run.still_from_end(columns.rows[row]).translation if run.on_track else end_m[row]
            )
            places.setdefault(move.wobj, []).append(place)
    in_plane = [np.zeros((1, 2))]
    for wobj, places_in_base in places.items():
        object_from_base = base_from_object(wobj, run.robot_run.world_from_base.inverse()).inverse()
        in_plane.append(object_from_base.apply(np.array(places_in_base))[:, :2])
    corners = np.concatenate(in_plane)
    low, high = corners.min(axis=0), corners.max(axis=0)
    half = np.maximum(0.5 * (high - low) * 1.5, _SMALLEST)
    centre = 0.5 * (low + high)
    stream.log(
        _entity(run, name, "plate"),
        rr.CoordinateFrame(run.frame(name)),
        rr.Boxes3D(
            centers=[[*centre, -_THICKNESS]],
            half_sizes=[[*half, 0.5 * _THICKNESS]],
            colors=palette.rgba(palette.WORK_PLANE),
            fill_mode=rr.components.FillMode.Solid,
        ),
        static=True,
    )
    stream.log(
        _entity(run, name, "name"),
        rr.CoordinateFrame(run.frame(name)),
        rr.Points3D(
            [[*_emptiest_corner(centre, half, corners), 0.0]],
            radii=rr.Radius.ui_points(0.0),
            colors=palette.rgba(palette.FRAME_NAME),
            labels=[name],
            show_labels=True,
        ),
        static=True,
    )


def _emptiest_corner(centre: Array, half: Array, targets: Array) -> Array:
    """Return the corner (2,) of a plate farthest from all targets (k, 2), for its name."""
    signs = np.array([[-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    corners = centre + half * signs
    distances = np.linalg.norm(corners[:, None] - targets[None], axis=2).min(axis=1)
    # Rounded, so that for equally far corners all machines select the first one.
    corner: Array = corners[int(np.argmax(np.round(distances, 6)))]
    return corner
