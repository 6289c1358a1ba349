"""Draw the pictures of the concept pages from runs of the programs that the pages show.

    python scripts/build_concepts.py

writes `docs/pictures/concept-*.png`. Each file carries what it shows in a text chunk: its words and
the numbers behind its lines. `tests/docs/test_docs_concepts.py` makes the figures anew and compares
that, so pictures are kept current whatever renders their pixels.
"""

from __future__ import annotations

import io
import json
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo

import rapidsim
from rapidsim.api.run import Run
from rapidsim.applications.kin.kin_steps import solved_postures
from rapidsim.colours import LIGHT
from rapidsim.frames.euler import Convention, rotation_from_euler
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Place
from rapidsim.motion.configurations.pose_solutions import solve_pose
from rapidsim.motion.configurations.postures import Postures
from rapidsim.plots.frames_picture import frames_picture
from rapidsim.plots.posture_pictures import pose_picture
from rapidsim.plots.sampled_run import sample_run
from rapidsim.plots.theme import mark_start, new_figure, themed
from rapidsim.simulation.results.move_kinds import MOVE_KINDS

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
CHUNK = "content"
COLOURS = 128
CORNER_MM = 160.0
"""How much around the corner is shown."""
STEP_S = 0.004
SERIES = ("#d93b38", "#2f6fe0", "#14954f", "#b53bb8")


def run_of_page(page: str, **options: Any) -> Run:
    """Run the program that a page shows."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = re.search(r'^```rapid title="(.*?)"\n(.*?)^```', text, re.MULTILINE | re.DOTALL)
    assert found
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, found[1])
        file.write_text(found[2], encoding="utf-8")
        return rapidsim.load(file, robot="irb1600-6-1.2", home=folder).run(**options)


def zones() -> Figure:
    """The corner from above, and the speed on the way, a colour a zone."""
    run = run_of_page("zones.md")
    figure = new_figure("One corner, four zones", width=9.4, height=4.2)
    above, over_time = figure.subplots(1, 2, width_ratios=[1.0, 1.35])
    corners = [run.moves[k : k + 3] for k in range(0, len(run.moves), 3)]
    for (_, first, second), colour in zip(corners, SERIES, strict=True):
        state = run.trajectory.at(np.arange(first.start_s, second.end_s, STEP_S))
        name = f"z{first.zone_mm:g}" if first.zone_mm else "fine"
        corner = np.array(first.target.position_mm)
        near = np.abs(state.position_mm - corner).max(axis=1) < CORNER_MM
        above.plot(*state.position_mm[near, 1::-1].T, color=colour, label=name)
        if first.zone_mm:
            angle = np.linspace(0.0, 2.0 * np.pi, 73)
            ring = corner[1::-1, None] + first.zone_mm * np.array([np.sin(angle), np.cos(angle)])
            above.plot(*ring, color=colour, linewidth=0.8, linestyle=":")
        times = np.asarray(state.time_s) - first.start_s
        over_time.plot(times, state.speed_mm_s, color=colour, label=name)
    above.plot(*corner[1::-1], marker="+", markersize=10, color=LIGHT.ink, linestyle="none")
    _name(above, "pCorner", corner[1::-1], LIGHT.ink)
    above.set_aspect("equal")
    above.set_title("TCP from above; dotted: the zones")
    above.set_xlabel("y [mm]")
    above.set_ylabel("x [mm]")
    over_time.set_title("TCP speed from pStart to pEnd")
    over_time.set_xlabel("time [s]")
    over_time.set_ylabel("[mm/s]")
    over_time.legend(loc="lower center", ncols=4)
    over_time.set_ylim(bottom=0.0)
    return figure


def pointer() -> Figure:
    """The way with the places where outputs are set, and both pointers over time."""
    run = run_of_page("program_pointer.md")
    one = run.simulation.only
    figure = new_figure("Program pointer and motion pointer", width=9.4, height=4.2)
    above, lanes = figure.subplots(1, 2, width_ratios=[1.0, 1.35])
    state = run.trajectory.at(np.arange(0.0, run.time_s, STEP_S))
    moving = np.asarray(state.time_s) >= run.moves[0].end_s
    way = state.position_mm[moving]
    above.plot(*way[:, 1::-1].T, color=LIGHT.tcp)
    for move in run.moves:
        place = np.array(move.target.position_mm)
        above.plot(*place[1::-1], marker="+", markersize=9, color=LIGHT.soft, linestyle="none")
        _name(above, str(move.to), place[1::-1], LIGHT.soft)
    for history in run.signals.values():
        (instant,) = history.rises_s
        place = run.trajectory.at(instant).position_mm
        mark_start(above, place[1::-1], LIGHT)
        _name(above, history.name, place[1::-1], LIGHT.tcp, left=True)
        lanes.axvline(instant, color=LIGHT.tcp, linewidth=1.0, linestyle=":")
        lanes.annotate(
            history.name, (instant, 1.0), xytext=(-3, 0), textcoords="offset points",
            rotation=90, ha="right", va="top", fontsize=8.0, color=LIGHT.tcp,
        )  # fmt: skip
    robot = [(move.start_s, move.end_s, f"{move.instruction} {move.to}") for move in run.moves]
    lines = [(line.time_s, _statement(line.place)) for line in one.lines]
    ends = [*(start for start, _ in lines[1:]), run.time_s]
    program = [(start, end, word) for (start, word), end in zip(lines, ends, strict=True)]
    _lane(lanes, 0.0, [bar for bar in program if bar[1] - bar[0] > 0.05], LIGHT.accent)
    _lane(lanes, -0.8, robot, LIGHT.moves[MOVE_KINDS[one.moves[-1].move.interpolation]])
    lanes.set_yticks([0.0, -0.8], ["program\npointer", "robot"])
    lanes.set_ylim(-1.2, 1.05)
    lanes.set_xlabel("time [s]")
    lanes.grid(visible=False, axis="y")
    lanes.set_title("what is being carried out")
    above.set_aspect("equal", adjustable="datalim")
    above.margins(0.16)
    above.set_title("TCP from above; a ring where an output is set")
    above.set_xlabel("y [mm]")
    above.set_ylabel("x [mm]")
    return figure


def _statement(place: Place) -> str:
    """The line and the beginning of a statement."""
    return f"{place.span.line}: {place.span.text.split(',')[0]}"


def _lane(axes: Axes, y: float, bars: Sequence[tuple[float, float, str]], colour: str) -> None:
    for start, end, words in bars:
        axes.barh(y, end - start, left=start, height=0.5, color=colour, edgecolor=LIGHT.panel)
        axes.text((start + end) / 2, y, words, ha="center", va="center", color="white", fontsize=8)


def _name(axes: Axes, name: str, place: Array, colour: str, *, left: bool = False) -> None:
    """Write a name beside a place (2,) in units of the axes: above on its left, or below."""
    offset, side = ((-7, 6), "right") if left else ((6, -13), "left")
    axes.annotate(
        name, (place[0], place[1]), xytext=offset, textcoords="offset points", color=colour, ha=side
    )


def work_objects() -> Figure:
    """Both triangles from above."""
    run = run_of_page("work_objects.md")
    figure = new_figure("Three targets in two work objects", width=8.0, height=3.8)
    above = figure.subplots()
    for name, colour in (("wLeft", SERIES[1]), ("wRight", SERIES[2])):
        moves = [move for move in run.moves if move.wobj == name]
        state = run.trajectory.at(np.arange(moves[0].end_s, moves[-1].end_s, STEP_S))
        above.plot(*state.position_mm[:, 1::-1].T, color=colour, label=name)
        places = np.array([move.target.position_mm[1::-1] for move in moves[:3]])
        for move, place in zip(moves, places, strict=False):
            above.plot(*place, marker="o", color=colour, linestyle="none")
            # Outside of the triangle; the axis across grows to the left.
            across, along = np.sign(place - places.mean(axis=0)) * (-11.0, 11.0)
            above.annotate(
                str(move.to), (place[0], place[1]), xytext=(across, along),
                textcoords="offset points", color=colour, ha="center", va="center",
            )  # fmt: skip
    above.set_aspect("equal", adjustable="datalim")
    above.margins(0.1)
    above.invert_xaxis()
    above.legend(loc="upper center")
    above.set_title("TCP from above, in the base frame of the robot")
    above.set_xlabel("y [mm]")
    above.set_ylabel("x [mm]")
    return figure


def frames() -> Figure:
    """The tree of frames of the same program, as `--plots` draws it."""
    run = run_of_page("work_objects.md").simulation
    return frames_picture(sample_run(run, run.only), LIGHT)


def configurations() -> Figure:
    """All branches of a pose, as `kin ik --all --plots` draws them."""
    arm = rapidsim.load_robot("irb1600-6-1.2")
    rotation = rotation_from_euler(np.radians([20.0, 0.0, 180.0]), Convention.ZYX)
    place = np.array([0.6, 0.2, 0.5])
    found = solve_pose(arm, Transform(rotation, place), everything=True)
    title = f"{arm.title} with the TCP at (600, 200, 500) mm"
    nowhere = Transform.identity()
    postures = solved_postures(found, arm.kinematics.turns)
    return pose_picture(Postures(arm, nowhere, nowhere, postures, title), LIGHT)


PICTURES: Mapping[str, Callable[[], Figure]] = {
    "zones": zones,
    "pointer": pointer,
    "configurations": configurations,
    "work-objects": work_objects,
    "frames": frames,
}


def figure_of(name: str) -> Figure:
    """A picture by its name, not drawn yet."""
    with themed(LIGHT):
        return PICTURES[name]()


def content(figure: Figure) -> list[list[Any]]:
    """What a figure shows: its words, and some numbers of every line."""
    return [*_content(figure)]


def _content(figure: Figure) -> Iterator[list[Any]]:
    if figure.get_suptitle():
        yield [figure.get_suptitle()]
    for axes in figure.axes:
        yield [axes.get_title("left"), axes.get_xlabel(), axes.get_ylabel()]
        yield [text.get_text() for text in axes.texts]
        for line in axes.lines:
            columns = line.get_data_3d() if hasattr(line, "get_data_3d") else line.get_data()
            yield [_numbers(np.asarray(column, dtype=np.float64)) for column in columns]


def _numbers(values: Any) -> list[float]:
    """A column in five numbers, as exact as any machine repeats it."""
    if not len(values):
        return []
    five = (values[0], values[-1], values.min(), values.max(), values.mean())
    return [round(float(value), 3) for value in five]


def written_content(name: str) -> list[list[Any]]:
    """What the file of a picture says that it shows."""
    with Image.open(path_of(name)) as picture:
        found: list[list[Any]] = json.loads(picture.info[CHUNK])
        return found


def path_of(name: str) -> Path:
    """The file of a picture."""
    return DOCS / "pictures" / f"concept-{name}.png"


def main() -> None:
    """Write all pictures."""
    for name in PICTURES:
        with themed(LIGHT):
            figure = PICTURES[name]()
            drawn_png = io.BytesIO()
            figure.savefig(drawn_png, format="png")
        info = PngInfo()
        info.add_text(CHUNK, json.dumps(content(figure)), zip=True)
        picture = Image.open(drawn_png).convert("RGB").quantize(COLOURS)
        picture.save(path_of(name), optimize=True, pnginfo=info)


if __name__ == "__main__":
    main()
