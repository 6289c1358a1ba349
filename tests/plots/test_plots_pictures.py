"""Pictures of a run: all are there, light and dark, and show what the run did."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from PIL import Image

import rapidsim
from rapidsim.colours import DARK, LIGHT
from rapidsim.files import InputError
from rapidsim.plots import write
from rapidsim.plots.comparison_picture import comparison_picture
from rapidsim.plots.frames_picture import frames_picture
from rapidsim.plots.lines_picture import lines_picture
from rapidsim.plots.path_picture import path_picture
from rapidsim.plots.sampled_run import pieces, sample_run
from rapidsim.plots.theme import themed
from rapidsim.plots.time_pictures import joints_picture, speed_picture
from rapidsim.plots.write import PICTURES, write_plots
from rapidsim.simulation.results.simulation import Simulation

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    return rapidsim.simulate([ROOT / "programs" / "out_of_reach.mod"], robot="irb1600")


def test_every_picture_is_there_light_and_dark(
    simulation: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # All of them light, two of them dark too: which theme a picture has is one place's business.
    monkeypatch.setattr(write, "THEMES", (LIGHT,))
    all_light = write_plots(simulation, tmp_path / "light")
    # No bodies are judged here.
    assert {path.stem for path in all_light} == set(PICTURES) - {"clearance"}
    monkeypatch.undo()
    some = {name: PICTURES[name] for name in ("arm", "speed")}
    monkeypatch.setattr(write, "PICTURES", some)
    folder = tmp_path / "plots"
    both = write_plots(simulation, folder)
    expected = {f"{name}{ending}.png" for name in some for ending in ("", "-dark")}
    assert {path.name for path in both} == expected == {p.name for p in folder.iterdir()}
    for path in all_light + both:
        picture = np.asarray(Image.open(path).convert("L"))
        page = picture[0, 0]
        assert (page < 60) == path.stem.endswith("-dark")
        assert np.count_nonzero(picture != page) > 2000


def test_the_same_run_gives_the_same_picture(simulation: Simulation, tmp_path: Path) -> None:
    run = sample_run(simulation, simulation.robots[0])
    pictures = []
    for name in ("one.png", "two.png"):
        with themed(LIGHT):
            figure = speed_picture(run, LIGHT)
            figure.savefig(tmp_path / name, metadata={"Software": None})
        pictures.append((tmp_path / name).read_bytes())
    assert pictures[0] == pictures[1]


def test_the_path_has_what_failed_in_it(simulation: Simulation) -> None:
    with themed(DARK):
        figure = path_picture(sample_run(simulation, simulation.robots[0]), DARK)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["MoveJ", "MoveL", "start", "not possible"]
    names = {text.get_text() for axes in figure.axes[1:] for text in axes.texts}
    assert {"pFront", "pSide"} <= names


def test_small_lines_are_shown_from_near(tmp_path: Path) -> None:
    """Four corners of 40 x 70 mm under a joint move of a metre; the corners are no blots."""
    corners = [(600, 0), (640, 0), (640, 70), (600, 70), (600, 0)]
    moves = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;"
    moves += "".join(
        f"MoveL [[{x},{y},300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v200,z5,tool0;"
        for x, y in corners
    )
    program = tmp_path / "small.mod"
    home = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;"
    to_first = moves.partition(";")[0].replace("MoveL", "MoveJ")
    program.write_text(
        f"MODULE small\n  PROC main()\n    {home}{to_first};{moves}\n  ENDPROC\nENDMODULE\n"
    )
    ran = rapidsim.simulate([program.as_posix()], robot="irb1600")
    with themed(LIGHT):
        figure = path_picture(sample_run(ran, ran.only), LIGHT)
    assert len(figure.axes) == 8
    above = figure.axes[5]
    assert above.get_title(loc="left") == "lines and arcs, from above"
    low, high = above.get_xlim()
    assert 40.0 < high - low < 120.0
    assert low < 600.0 < 640.0 < high


def test_joints_stand_between_their_limits(simulation: Simulation) -> None:
    with themed(LIGHT):
        figure = joints_picture(sample_run(simulation, simulation.robots[0]), LIGHT)
    robot = simulation.only.robot
    for k, axes in enumerate(figure.axes):
        low, high = axes.get_ylim()
        assert low < np.degrees(robot.lower[k]) < np.degrees(robot.upper[k]) < high


def test_the_bars_are_the_times_of_the_lines(simulation: Simulation) -> None:
    with themed(LIGHT):
        figure = lines_picture(sample_run(simulation, simulation.robots[0]), LIGHT)
    bars = [bar for bar in figure.axes[0].patches if isinstance(bar, Rectangle)]
    widths = [bar.get_width() for bar in bars]
    assert sum(widths) == pytest.approx(
        sum(move.end_s - move.start_s for move in simulation.moves), rel=1e-9
    )


def test_movej_leaves_the_line_that_movel_keeps(simulation: Simulation) -> None:
    with themed(LIGHT):
        figure = comparison_picture(sample_run(simulation, simulation.robots[0]), LIGHT)
    assert figure is not None
    joint, line = (np.asarray(curve.get_data()).T for curve in figure.axes[0].lines[:2])
    assert np.allclose(joint[[0, -1]], line[[0, -1]], atol=1e-3)
    assert np.abs(joint - line).max() > 5.0


def test_frames_hang_on_one_another(simulation: Simulation) -> None:
    with themed(LIGHT):
        figure = frames_picture(sample_run(simulation, simulation.robots[0]), LIGHT)
    words = [text.get_text() for text in figure.axes[0].texts]
    assert words[0] == "world"
    assert "wPlate object frame" in words
    assert any("600.00" in text for text in words)


def test_pieces_join() -> None:
    assert pieces(np.array([True, True, False, True])) == [slice(0, 3), slice(3, 4)]


def test_other_robots_have_pictures_of_their_own(
    simulation: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(write, "PICTURES", {"path": lambda run, theme: Figure((1, 1))})
    other = replace(simulation.only, task="T_ROB2")
    both = replace(simulation, robots=(simulation.only, other))
    written = write_plots(both, tmp_path / "plots")
    assert {"path.png", "T_ROB2-path.png"} <= {path.name for path in written}


def test_a_run_without_moves_says_so(simulation: Simulation, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="nothing moved"):
        write_plots(with_robot(simulation, moves=()), tmp_path / "plots")
