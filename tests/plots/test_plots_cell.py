"""Outlines of the objects of a cell: what a draughtsman draws, where it stands, red where hit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

import rapidsim
from rapidsim.collisions.shape import Shape, box, cylinder, sphere
from rapidsim.colours import LIGHT
from rapidsim.frames.transform import Array
from rapidsim.plots.cell_outline import (
    CellOutline,
    cell_of,
    draw_cell,
    draw_cell_in_space,
    outlined,
)
from rapidsim.plots.path_picture import path_picture
from rapidsim.plots.sampled_run import sample_run
from rapidsim.plots.theme import themed

PROGRAMS = Path(__file__).parents[2] / "programs"
ABOVE, SIDE = (0, 1), (0, 2)


def cell_with(shape: Shape) -> CellOutline:
    return CellOutline((outlined("#336699", 1000.0 * shape.vertices, shape.faces),))


def lines_of(axes: Axes) -> Array:
    (lines,) = [one for one in axes.collections if isinstance(one, LineCollection)]
    return np.array(lines.get_segments())


def outline(shape: Shape, shown: tuple[int, int]) -> Array:
    """The edges (e, 2, 2) [mm] that are drawn."""
    axes = Figure().subplots()
    draw_cell(axes, cell_with(shape), LIGHT, shown)
    return lines_of(axes)


def test_a_box_is_its_rectangle() -> None:
    edges = outline(box(np.array([0.2, 0.1, 0.3])), ABOVE)
    assert len(edges) == 4
    assert np.unique(edges.reshape(-1, 2), axis=0).tolist() == [
        [-100, -50], [-100, 50], [100, -50], [100, 50]
    ]  # fmt: skip


def test_a_sphere_is_a_circle() -> None:
    edges = outline(sphere(0.08), SIDE)
    assert np.linalg.norm(edges, axis=2) == pytest.approx(80.0, rel=0.01)
    middles = edges.mean(axis=1)
    around = np.sort(np.degrees(np.arctan2(middles[:, 1], middles[:, 0])))
    assert np.diff(around, append=around[0] + 360.0).max() < 10.0


def test_a_cylinder_is_a_rectangle_from_the_side() -> None:
    """Its wall has no edge, but turns away from the eye."""
    edges = outline(cylinder(0.03, 0.1), SIDE)
    upright = edges[np.ptp(edges[..., 1], axis=1) > 1.0]
    assert np.abs(upright[..., 0]) == pytest.approx(30.0, rel=0.01)
    assert np.abs(edges[..., 1]).max() == pytest.approx(50.0)


def test_in_space_nothing_leaves_the_view() -> None:
    """The view in space cuts nothing off: a table of 2 m under a path of 0.2 m would cover all."""
    axes = Figure().add_subplot(projection="3d")
    for set_ends in (axes.set_xlim, axes.set_ylim, axes.set_zlim):
        set_ends(-100.0, 300.0)
    draw_cell_in_space(axes, cell_with(box(np.array([2.0, 0.1, 0.1]))), LIGHT)
    (lines,) = axes.collections
    edges = np.array(lines._segments3d)
    assert (edges[..., 0].min(), edges[..., 0].max()) == (-100.0, 300.0)
    assert edges[..., 1].max() == edges[..., 2].max() == 50.0


def test_objects_stand_in_the_path_picture_and_what_is_hit_is_red() -> None:
    ran = rapidsim.simulate([PROGRAMS / "machine_tending" / "Hasty.mod"])
    run = sample_run(ran, ran.robots[0])
    cell = cell_of(run, LIGHT)
    assert ran.collisions is not None
    names = [one.name for one in ran.collisions.objects.values() if one.name != "floor"]
    first = [one for one in cell.bodies if not one.is_later]
    hit = {name for name, one in zip(names, first, strict=True) if one.colour == LIGHT.error}
    assert hit == {"door frame, right", "gripper", "part"}
    # The gripper and the part it carries are elsewhere at the end.
    assert len(cell.bodies) == len(names) + 2
    with themed(LIGHT):
        figure = path_picture(run, LIGHT)
    assert "contact" in [text.get_text() for text in figure.legends[0].get_texts()]
    for axes in figure.axes[1:4]:
        colours = {
            to_hex(np.asarray(one.get_edgecolor())[0])
            for one in axes.collections
            if isinstance(one, LineCollection)
        }
        assert {LIGHT.error, "#4a6fa5"} <= colours


def test_a_run_without_objects_has_no_cell() -> None:
    ran = rapidsim.simulate([PROGRAMS / "circle.mod"])
    assert cell_of(sample_run(ran, ran.robots[0]), LIGHT).bodies == ()
