"""Writer of the pictures of a run into a folder, each light and dark.

`path.png`, `arm.png`, `joints.png`, `speed.png`, `orientation.png`, `lines.png`, `movej-movel.png`,
`frames.png` and, if bodies are checked, `clearance.png`, with `-dark` before the suffix for the
dark ones, and the task before the name for all robots but the first. Equal runs produce equal
files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from types import MappingProxyType

from matplotlib.figure import Figure

from rapidsim.colours import DARK, LIGHT, Colours
from rapidsim.files import InputError, did_you_mean
from rapidsim.output_files import unwritten, whole_file
from rapidsim.plots.arm_picture import arm_picture
from rapidsim.plots.clearance_picture import clearance_picture
from rapidsim.plots.comparison_picture import comparison_picture
from rapidsim.plots.frames_picture import frames_picture
from rapidsim.plots.lines_picture import lines_picture
from rapidsim.plots.path_picture import path_picture
from rapidsim.plots.sampled_run import sample_run
from rapidsim.plots.theme import themed
from rapidsim.plots.time_pictures import joints_picture, orientation_picture, speed_picture
from rapidsim.simulation.results.sampling import SampledRun
from rapidsim.simulation.results.simulation import RobotRun, Simulation

PICTURES: Mapping[str, Callable[[SampledRun, Colours], Figure | None]] = MappingProxyType(
    {
        "path": path_picture,
        "arm": arm_picture,
        "joints": joints_picture,
        "speed": speed_picture,
        "orientation": orientation_picture,
        "lines": lines_picture,
        "movej-movel": comparison_picture,
        "frames": frames_picture,
        "clearance": clearance_picture,
    }
)
"""Pictures by file name; a picture without content returns no figure."""
THEMES = (LIGHT, DARK)
_NOTHING_MOVED = "nothing moved: there is no path to draw pictures of"


def write_plots(simulation: Simulation, folder: str | Path) -> tuple[Path, ...]:
    """Write the pictures of a run.

    Args:
        simulation: The run.
        folder: Target folder, which is created if its parent exists.

    Returns:
        The files written; empty for a run without moves.

    Raises:
        InputError: If the files cannot be written, or nothing moved.
    """
    if not any(one.moves for one in simulation.robots):
        raise InputError(_NOTHING_MOVED)
    written: list[Path] = []
    for number, one in enumerate(simulation.robots):
        if one.moves:
            # The names of the first robot's pictures do not depend on the number of robots.
            before = f"{one.task}-" if number else ""
            run = sample_run(simulation, one)
            pictures = {
                f"{before}{name}": partial(picture, run) for name, picture in PICTURES.items()
            }
            written += write_pictures(pictures, Path(folder))
    return tuple(written)


def draw(simulation: Simulation, robot_run: RobotRun, name: str, *, dark: bool = False) -> Figure:
    """Draw one picture.

    Args:
        simulation: The run.
        robot_run: The robot.
        name: Name of the picture.
        dark: Whether it is for a dark page.

    Raises:
        InputError: If there is no picture of that name, or nothing that it could show.
    """
    if name not in PICTURES:
        raise InputError(f"there is no picture `{name}`", did_you_mean(name, PICTURES))
    if not robot_run.moves:
        raise InputError(_NOTHING_MOVED)
    theme = DARK if dark else LIGHT
    with themed(theme):
        figure = PICTURES[name](sample_run(simulation, robot_run), theme)
    if figure is None:
        raise InputError(f"this run has nothing for the picture `{name}`")
    return figure


def write_pictures(
    pictures: Mapping[str, Callable[[Colours], Figure | None]], folder: Path
) -> tuple[Path, ...]:
    """Write pictures by the names of their files, light and dark.

    Raises:
        InputError: If the files cannot be written.
    """
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise unwritten(folder, error.strerror or str(error)) from error
    written = []
    for theme in THEMES:
        for name, picture in pictures.items():
            ending = "" if theme is LIGHT else f"-{theme.name}"
            path = folder / f"{name}{ending}.png"
            with themed(theme):
                figure = picture(theme)
                if figure is None:
                    continue
                with whole_file(path) as temporary:
                    # No name and version of the plotting program: equal runs produce equal files.
                    figure.savefig(temporary, format="png", metadata={"Software": None})
            written.append(path)
    return tuple(written)
