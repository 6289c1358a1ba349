"""Make the pictures of the documentation from real runs.

    python scripts/build_pictures.py

writes `docs/pentagon.png`. It needs what `scripts/screenshot.py` needs: a Vulkan driver.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from screenshot import shoot

ROOT = Path(__file__).parents[1]
TIME_S = 6.2
"""The pen is on the sheet, in the middle of the first figure."""
COLOURS = 256
WIDTH = 1600


def main() -> None:
    """Run the drawing program and photograph it."""
    with tempfile.TemporaryDirectory() as folder:
        recording = Path(folder) / "pentagon.rrd"
        program = ROOT / "programs" / "pentagon.mod"
        answers = ROOT / "programs" / "pentagon.answers.txt"
        command = [sys.executable, "-m", "rapidsim", "run", str(program), "--format", "none"]
        command += ["--answers", str(answers), "--record", str(recording), "--home", folder]
        subprocess.run(command, check=True)
        (shot,) = shoot(recording, [TIME_S], width=WIDTH)
    picture = Image.open(io.BytesIO(shot.png)).convert("RGB")
    # Few colours keep the repository small. A palette that covers all hues keeps thin lines apart,
    # and dithering keeps surfaces smooth.
    palette = picture.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE)
    small = picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
    small.save(ROOT / "docs" / "pentagon.png", optimize=True)


if __name__ == "__main__":
    main()
