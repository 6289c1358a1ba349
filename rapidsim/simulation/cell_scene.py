"""Build the moving bodies of a run in its cell, and the pairs of them to check for collisions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.geometry import CellGeometry, CellObject
from rapidsim.collisions.outer_hull import HullStore
from rapidsim.collisions.scene import Scene
from rapidsim.collisions.shape import sphere
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.simulation.cell_bodies import CellBodies
from rapidsim.simulation.part_courses import part_courses
from rapidsim.simulation.part_supply import part_holders, part_sinks
from rapidsim.simulation.results.parts import PartEvent
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.scene_pairs import ScenePairs, lying
from rapidsim.values import value_class

_POINT = sphere(1e-6)
"""The TCP as a body."""


@value_class(frozen=True, slots=True, eq=False)
class CellScene:
    """Bodies of a run that are checked for collisions, with remarks on those that are not."""

    scene: Scene
    remarks: tuple[str, ...]
    """Reasons why bodies or pairs are not checked."""
    objects: Mapping[int, CellObject]
    """Objects of the station by their number among the bodies."""
    bodies: Bodies
    """Bodies of the scene, laid out for distance computations."""
    parts: tuple[int, ...]
    """Numbers of the bodies that grippers take, or that appear and disappear."""
    events: tuple[PartEvent, ...]
    """Changes of their carriers."""


def cell_scene(
    simulation: Simulation,
    geometry: CellGeometry,
    conveyors: Sequence[ConveyorScript],
    hulls: HullStore | None = None,
) -> CellScene:
    """Return the bodies of a run and the pairs of them that must not touch."""
    cell = CellBodies(simulation, geometry, conveyors)
    distances = Bodies([*(body.shape for body in cell.bodies), _POINT], hulls)
    holders = tuple(part_holders(cell, geometry))
    courses = part_courses(cell, distances, holders, tuple(part_sinks(cell, geometry)))
    for number, course in courses.parts.items():
        cell.bodies[number] = replace(
            cell.bodies[number],
            carried=course.carried,
            from_s=course.from_s,
            until_s=course.until_s,
        )
    finder = ScenePairs(cell, geometry, holders)
    pairs = tuple(finder.pairs())
    for ignored in finder.unused():
        cell.remarks.append(
            f"the station ignores `{ignored.first}` and `{ignored.second}`: no such pair"
        )
    scene = Scene(cell.arms, tuple(cell.bodies), pairs, cell.belts)
    return CellScene(
        lying(scene, distances, courses.parts.keys()),
        tuple(dict.fromkeys(cell.remarks)),
        cell.objects,
        distances,
        tuple(courses.parts),
        courses.events,
    )
