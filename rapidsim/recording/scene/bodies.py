"""Bodies of the station file in the cell and on robots; red when they touch.

An object is red from a contact to the end of its move. The links of an arm keep their colour under
a red skin.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import rerun as rr

from rapidsim.collisions.contact import Contact
from rapidsim.collisions.scene import Poses
from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Transform
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.surface import surface
from rapidsim.recording.transforms import WORLD, moving_frame, static_frame
from rapidsim.simulation.results.collisions import Collisions

ENTITY = "cell"
_SKIN = 1.01
"""Scale of a skin relative to the link, so that it covers it."""
_SHOWN_M = 3.0
"""Half the side of the visible part of a floor."""


def log_bodies(stream: rr.RecordingStream, runs: Sequence[RecordedRobot]) -> None:
    """Log the objects of the station, their motion, and their contacts."""
    collisions = runs[0].sampled.simulation.collisions
    if collisions is None:
        return
    clock, times = runs[0].clock, runs[0].samples.times
    poses = collisions.scene.poses(times)
    for number, one in collisions.objects.items():
        body = collisions.scene.bodies[number]
        frame = entity = rr.new_entity_path([ENTITY, one.name]).removeprefix("/")
        if body.is_static:
            place = body.carried[0].frame_from_body
            stream.log(f"{entity}/frame", static_frame(WORLD, frame, place), static=True)
        else:
            stream.send_columns(
                f"{entity}/frame",
                indexes=clock.columns(times),
                columns=moving_frame(WORLD, frame, _course(poses, number)),
            )
        stream.log(entity, rr.CoordinateFrame(frame), static=True)
        shape = surface(_within_sight(body.shape), one.colour)
        if body.is_lasting:
            stream.log(entity, shape, static=True)
        elif body.from_s < body.until_s:
            clock.set(stream, body.from_s)
            stream.log(entity, shape)
            if body.until_s < np.inf:
                clock.set(stream, body.until_s)
                stream.log(entity, rr.Clear(recursive=False))
            stream.reset_time()
    for number, contacts in _by_body(collisions):
        _log_red(stream, runs, collisions, number, contacts)


def _by_body(collisions: Collisions) -> Iterator[tuple[int, list[Contact]]]:
    """Yield the bodies that touch something, with their contacts."""
    for number, body in enumerate(collisions.scene.bodies):
        own = [one for one in collisions.hits if body.label in (one.first, one.second)]
        if own:
            yield number, own


def _log_red(
    stream: rr.RecordingStream,
    runs: Sequence[RecordedRobot],
    collisions: Collisions,
    number: int,
    contacts: Sequence[Contact],
) -> None:
    """Log a red skin over a body, from each contact to the end of its move."""
    body = collisions.scene.bodies[number]
    entity = rr.new_entity_path([ENTITY, "contact", str(number)]).removeprefix("/")
    shape, clock = _within_sight(body.shape), runs[0].clock
    middle = 0.5 * (shape.vertices.max(axis=0) + shape.vertices.min(axis=0))
    skin = Shape((), middle + _SKIN * (shape.vertices - middle), shape.faces)
    times = runs[0].samples.times
    ends: list[float] = []
    for one in contacts:
        moves = runs[one.robot].robot_run.moves
        end_s = next((move.end_s for move in moves if move.index == one.move), one.time_s)
        if ends and one.time_s < ends[-1]:
            continue
        ends.append(end_s)
        clock.set(stream, one.time_s)
        stream.log(entity, surface(skin, palette.FAILED))
        clock.set(stream, end_s)
        stream.log(entity, rr.Clear(recursive=False))
    stream.reset_time()
    frame = f"{ENTITY}/contact/{number}"
    stream.send_columns(
        f"{entity}/frame",
        indexes=clock.columns(times),
        columns=moving_frame(WORLD, frame, _course(collisions.scene.poses(times), number)),
    )
    stream.log(entity, rr.CoordinateFrame(frame), static=True)


def _course(poses: Poses, number: int) -> Transform:
    return Transform(poses.rotation[:, number], poses.translation[:, number])


def _within_sight(shape: Shape) -> Shape:
    """Return a floor as a plate: one of 200 m would push the arm out of the picture."""
    if np.abs(shape.vertices).max() <= 10.0 * _SHOWN_M:
        return shape
    vertices = np.clip(shape.vertices, [-_SHOWN_M, -_SHOWN_M, -0.01], [_SHOWN_M, _SHOWN_M, 0.0])
    return Shape((), vertices, shape.faces)
