"""The objects of a cell for the page: their poses, what they are attached to, their hulls.

A page draws outlines of convex bodies; a shape with bays is drawn filled.
"""

from __future__ import annotations

from rapidsim.frames.transform import Array
from rapidsim.report.html.arm_shapes import connected_bodies, outermost
from rapidsim.report.html.packing import packed_columns
from rapidsim.simulation.results.relative_motion import is_shown_in_world, shown_from_world
from rapidsim.simulation.results.simulation import Simulation

_MM = 1000.0


def objects_data(simulation: Simulation, times: Array) -> list[dict[str, object]]:
    """The objects of the station as JSON values, at evenly spaced instants (k,) [s]."""
    collisions = simulation.collisions
    if collisions is None:
        return []
    in_world = is_shown_in_world(simulation)
    picture_from_world = shown_from_world(simulation.robots[0], in_world=in_world)
    poses = collisions.scene.poses(times)
    found: list[dict[str, object]] = []
    for number, one, body in collisions.drawn_objects():
        stands = picture_from_world @ poses.of(number)
        if body.is_static:
            stands = stands[:1]
        spans = {} if body.is_lasting else {"exists": _within(times, body.from_s, body.until_s)}
        found.append(
            {
                **spans,
                "name": one.name,
                "colour": one.hex_colour,
                "parts": [
                    outermost(part)
                    for part in connected_bodies(body.shape.vertices, body.shape.faces)
                ],
                "turn": packed_columns(stands.rotation.reshape(len(stands), -1), 6),
                "place": packed_columns(_MM * stands.translation, 1),
            }
        )
    return found


def _within(times: Array, from_s: float, until_s: float) -> list[float]:
    """Return the part of an interval [s] that is within the times of the page."""
    return [max(from_s, float(times[0])), min(until_s, float(times[-1]) + 1.0)]
