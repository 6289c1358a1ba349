"""Make the pictures of the documentation from real runs.

    python scripts/build_pictures.py [NAME ...]

writes `docs/pictures/NAME-1.png` to `-3.png`, each run at three instants, and `docs/pentagon.png`;
`report`, `plots` and `letter_d` are names too. It needs what `scripts/screenshot.py` needs, a
Vulkan driver, and for the report Chromium. What a view of the viewer complains of ends the script.
"""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from PIL import Image
from screenshot import shoot

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "docs" / "pictures"
COLOURS = 256
WIDTH = 1440
COVER_WIDTH = 1600
COVER_TIME_S = 6.2
"""The pen is on the sheet, in the middle of the first figure."""
MENU_HEIGHT = 31
"""Rows [pixels] of the viewer's menu, which says on which machine the picture was drawn."""
REPORT_SIZE = (1280, 2400)
PLOTS = ("path", "speed", "movej-movel", "arm")


@dataclass(frozen=True, slots=True)
class Run:
    """A run worth a look, and when."""

    program: str
    times_s: tuple[float, float, float]
    arguments: tuple[str, ...] = ()
    exit_code: int = 0


RUNS = {
    "pentagon": Run(
        "pentagon.mod",
        (2.0, 6.2, 10.4),
        ("--answers", str(ROOT / "programs" / "pentagon.answers.txt")),
    ),
    "circle": Run("circle.mod", (0.6, 5.0, 10.0)),
    "out_of_reach": Run("out_of_reach.mod", (0.6, 3.0, 6.2), exit_code=1),
    "cell": Run("cell", (1.4, 3.9, 9.0)),
    "two_robots": Run("two_robots/Left.mod", (1.8, 4.2, 8.6)),
    "belt_track": Run("belt_track/Track.mod", (2.0, 6.0, 10.0)),
}


def main() -> None:
    """Make the pictures named, or all."""
    names = sys.argv[1:] or [*RUNS, "report", "plots", "letter_d"]
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            match name:
                case "report":
                    _report(Path(scratch))
                case "plots":
                    _plots(Path(scratch))
                case "letter_d":
                    _letter(Path(scratch))
                case _:
                    _recording(name, Path(scratch))


def _recording(name: str, scratch: Path) -> None:
    run = RUNS[name]
    recording = scratch / f"{name}.rrd"
    simulate(run, scratch, "--record", str(recording))
    cover = (COVER_TIME_S,) if name == "pentagon" else ()
    shots = shoot(recording, [*run.times_s, *cover], width=COVER_WIDTH)
    for number, shot in enumerate(shots, start=1):
        if shot.complaints:
            raise SystemExit(f"{name}: {'; '.join(shot.complaints)}")
        if number > len(run.times_s):
            _save(shot.png, ROOT / "docs" / "pentagon.png", COVER_WIDTH, top=MENU_HEIGHT)
        else:
            _save(shot.png, PICTURES / f"{name}-{number}.png", WIDTH, top=MENU_HEIGHT)


def _report(scratch: Path) -> None:
    """The report of the cell, as Chromium shows it."""
    page = scratch / "report.html"
    simulate(RUNS["cell"], scratch, "--no-record", "--report", str(page))
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        raise SystemExit("the picture of the report needs Chromium")
    picture = scratch / "report.png"
    size = ",".join(map(str, REPORT_SIZE))
    command = [chromium, "--headless", "--no-sandbox", "--hide-scrollbars", f"--window-size={size}"]
    command += ["--virtual-time-budget=3000", f"--screenshot={picture}", page.as_uri()]
    subprocess.run(command, check=True, capture_output=True)
    _save(picture.read_bytes(), PICTURES / "report.png", REPORT_SIZE[0])


def _plots(scratch: Path) -> None:
    folder = scratch / "plots"
    simulate(RUNS["pentagon"], scratch, "--no-record", "--plots", str(folder))
    for name in PLOTS:
        picture = (folder / f"{name}.png").read_bytes()
        _save(picture, PICTURES / f"plot-{name}.png", WIDTH)


def _letter(scratch: Path) -> None:
    """The letter that an arm draws from a table of points."""
    recording = scratch / "letter_d.rrd"
    command = [sys.executable, "-m", "rapidsim", "follow", str(ROOT / "programs" / "letter_d.csv")]
    command += ["--robot", "rvm1", "--path", "spline", "--speed", "50", "-q"]
    subprocess.run([*command, "--record", str(recording)], check=True)
    (shot,) = shoot(recording, [6.0], width=COVER_WIDTH)
    _save(shot.png, ROOT / "docs" / "letter_d.png", WIDTH, top=MENU_HEIGHT)


def simulate(run: Run, scratch: Path, *outputs: str) -> None:
    """Run a program of the repository with options for its outputs."""
    program = str(ROOT / "programs" / run.program)
    command = [sys.executable, "-m", "rapidsim", "run", program, "--format", "none"]
    command += ["--home", str(scratch), *run.arguments, *outputs]
    done = subprocess.run(command, check=False)
    if done.returncode != run.exit_code:
        raise SystemExit(f"{program} ended with {done.returncode}, not {run.exit_code}")


def _save(png: bytes, path: Path, width: int, *, top: int = 0) -> None:
    """Write a picture, without some rows at its top, as few bytes.

    Few colours keep the repository small. A palette that covers all hues keeps thin lines apart,
    and dithering keeps surfaces smooth.
    """
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    picture = picture.crop((0, top, picture.width, picture.height))
    if picture.width > width:
        height = round(picture.height * width / picture.width)
        picture = picture.resize((width, height), Image.Resampling.LANCZOS)
    palette = picture.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE)
    small = picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
    small.save(path, optimize=True)


if __name__ == "__main__":
    main()
