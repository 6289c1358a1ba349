"""Take a picture of a recording with the viewer, without a screen.

    python scripts/screenshot.py pentagon.rrd pentagon.png --time 4.2

Needs a Vulkan driver; Mesa's software one will do (`apt-get install mesa-vulkan-drivers`).
"""

from __future__ import annotations

import argparse
import shutil
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from rerun.experimental import ViewerClient

from rapidsim.recording.page.viewer_files import free_port

TIMELINE = "sim_time"
LOAD_TIMEOUT_S = 120.0
ATTEMPTS = 3
"""A viewer that draws in software, on a computer with other work, is late now and then."""
TOASTS_S = 6.0
"""The viewer's own notes about the software renderer cover a corner for so long."""


@dataclass(frozen=True, slots=True)
class Shot:
    """What the viewer shows at an instant."""

    png: bytes
    complaints: tuple[str, ...]
    """Warnings and errors that views report."""
    world_from_frame: Mapping[str, npt.NDArray[np.float64]]
    """Homogeneous matrices (4, 4) [m] of the named frames, as the viewer resolves them."""


def vulkan_missing() -> str | None:
    """Why no picture can be taken here; None if one can."""
    if sys.platform != "linux":
        return None
    drivers = [
        driver
        for folder in ("/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d")
        for driver in Path(folder).glob("*.json")
    ]
    return None if drivers else "no Vulkan driver is installed (mesa-vulkan-drivers has one)"


@contextmanager
def viewer(recording: Path) -> Iterator[ViewerClient]:
    """A headless viewer with a recording loaded; it ends with the block.

    Raises:
        TimeoutError: When the recording does not load.
        FileNotFoundError: When recording or viewer do not exist.
    """
    path = str(recording.resolve(strict=True))
    # The one that was installed with this Python, whatever PATH says.
    found = shutil.which("rerun", path=str(Path(sys.executable).parent)) or shutil.which("rerun")
    if found is None:
        raise FileNotFoundError("there is no `rerun` beside this Python and none on PATH")
    with ViewerClient.spawn(
        headless=True, port=free_port(), hide_welcome_screen=True, executable_path=found
    ) as client:
        client.open(path)
        deadline = time.monotonic() + LOAD_TIMEOUT_S
        while client.get_state().loading:
            if time.monotonic() > deadline:
                raise TimeoutError(f"{recording} did not load in {LOAD_TIMEOUT_S:g} s")
            time.sleep(0.1)
        yield client


def shoot(
    recording: Path, times_s: Sequence[float], *, width: int = 1600, wait_s: float = TOASTS_S
) -> tuple[Shot, ...]:
    """Look at a recording at some instants [s], with another viewer where one is late.

    Raises:
        TimeoutError: When all viewers are.
        FileNotFoundError: When recording or viewer do not exist.
    """
    reason = ""
    for _ in range(ATTEMPTS):
        try:
            with viewer(recording) as client:
                return _looked_at(client, times_s, width, wait_s)
        except (ConnectionError, RuntimeError, TimeoutError) as late:
            reason = str(late)
    raise TimeoutError(f"the viewer was late {ATTEMPTS} times in a row: {reason}")


def _looked_at(
    client: ViewerClient, times_s: Sequence[float], width: int, wait_s: float
) -> tuple[Shot, ...]:
    client.set_time(TIMELINE, duration=times_s[0], play_state="paused")
    # The first frames are still being filled.
    client.take_screenshot(max_size=width)
    time.sleep(wait_s)
    return tuple(_shot(client, time_s, width) for time_s in times_s)


def _shot(client: ViewerClient, time_s: float, width: int) -> Shot:
    client.set_time(TIMELINE, duration=time_s, play_state="paused")
    for _ in range(2):
        client.take_screenshot(max_size=width)
    png = client.take_screenshot(max_size=width)
    complaints = tuple(
        f"{view.name}: {report.summary}"
        for view in client.get_state().views
        for report in view.reports
    )
    return Shot(png, complaints, _frames(client))


def _frames(client: ViewerClient) -> dict[str, npt.NDArray[np.float64]]:
    """Named frames in the root of their tree, resolved over the edges that the viewer knows."""
    graph = client.get_transform_graph(frame_filter="named", include_transforms=True)
    edges = {
        edge["child"]: (edge["parent"], np.array(edge["source"]["parent_from_child"]))
        for edge in graph["edges"]
        if edge["source"]["kind"] == "transform"
    }
    return {frame["id"]: _root_from(frame["id"], edges) for frame in graph["frames"]}


def _root_from(
    frame: str, edges: Mapping[str, tuple[str, npt.NDArray[np.float64]]]
) -> npt.NDArray[np.float64]:
    root_from_frame = np.eye(4)
    while frame in edges:
        frame, parent_from_child = edges[frame]
        root_from_frame = parent_from_child @ root_from_frame
    return root_from_frame


def main() -> int:
    """Read the command line and take the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--time", type=float, default=0.0, help="virtual time [s]")
    parser.add_argument("--width", type=int, default=1600, help="longest side [pixels]")
    arguments = parser.parse_args()
    missing = vulkan_missing()
    if missing:
        print(missing, file=sys.stderr)
        return 2
    try:
        (shot,) = shoot(arguments.recording, [arguments.time], width=arguments.width)
    except (FileNotFoundError, TimeoutError) as failure:
        print(f"no picture: {failure}", file=sys.stderr)
        return 2
    arguments.picture.write_bytes(shot.png)
    for complaint in shot.complaints:
        print(complaint, file=sys.stderr)
    return 1 if shot.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
