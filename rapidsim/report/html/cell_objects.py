"""The objects of a cell for the page: where they stand, or are carried, and their outer corners.

A page draws outlines of convex bodies; a shape with bays is drawn filled.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.report.html.arm_shapes import apart, outermost
from rapidsim.report.html.packing import packed_columns
from rapidsim.simulation.results.relative_motion import is_shown_in_world
from rapidsim.simulation.results.simulation import Simulation

_MM = 1000.0
_WIDEST_M = 10.0
"""What is wider is a floor or a wall, which would hide the rest."""


def objects_data(simulation: Simulation, times: Array) -> list[dict[str, object]]:
    """The objects of the station as JSON values, at evenly spaced instants (k,) [s]."""
    collisions = simulation.collisions
    if collisions is None:
        return []
    shown_from_world = Transform.identity()
    if not is_shown_in_world(simulation):
        shown_from_world = simulation.robots[0].world_from_base.inverse()
    poses = collisions.scene.poses(times)
    found: list[dict[str, object]] = []
    for number, one in collisions.objects.items():
        body = collisions.scene.bodies[number]
        corners, faces = body.shape.vertices, body.shape.faces
        if float(np.ptp(corners, axis=0).max()) > _WIDEST_M:
            continue
        stands = shown_from_world @ poses.of(number)
        if body.stands:
            stands = stands[:1]
        red, green, blue = one.colour[:3]
        found.append(
            {
                "name": one.name,
                "colour": f"#{red:02x}{green:02x}{blue:02x}",
                "parts": [outermost(part) for part in apart(corners, faces)],
                "turn": packed_columns(stands.rotation.reshape(len(stands), -1), 6),
                "place": packed_columns(_MM * stands.translation, 1),
            }
        )
    return found
