"""Take the pictures of docs/editor.md: VS Code with the extension, on a cell with a mistake.

    python scripts/build_editor_pictures.py ~/.cache/rapidsim-code-server

The folder is for downloads (800 MB, once). Needs npm and Chromium. Look at the pictures afterwards.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

from code_server import ROOT, CodeServer, UnavailableError, install, package_extension, serve
from PIL import Image

PICTURES = ROOT / "docs" / "pictures"
NAMES = ("editor-problems", "editor-record", "editor-debugger")
MISTAKES = (
    # The press is farther away than the arm reaches, and a name is mistyped.
    ('wPress:=[FALSE,TRUE,"",[[550,400,350]', 'wPress:=[FALSE,TRUE,"",[[1150,700,350]'),
    ("    place;\n", "    plaec;\n"),
)


def take(programs: CodeServer, names: Sequence[str], folder: Path) -> None:
    """Take pictures; what they need is built in a folder."""
    extension = package_extension(folder)
    for name in ("cell", "faulty/cell"):
        shutil.copytree(ROOT / "programs" / "cell", folder / name)
    module = folder / "faulty" / "cell" / "PickAndPlace.mod"
    text = module.read_text(encoding="utf-8")
    for right, wrong in MISTAKES:
        assert right in text, right
        text = text.replace(right, wrong)
    module.write_text(text, encoding="utf-8")
    with serve(programs, extension, folder / "server") as url:
        for name in names:
            cell = folder / ("faulty/cell" if name == NAMES[0] else "cell")
            taken = folder / f"{name}.png"
            script = ROOT / "scripts" / "build_editor_pictures.mjs"
            programs.drive(script, url, name, cell, taken)
            (PICTURES / f"{name}.png").write_bytes(_small(taken.read_bytes()))


def _small(png: bytes) -> bytes:
    """Return a picture with its 256 most frequent colours, which is a third of its size."""
    small = BytesIO()
    with Image.open(BytesIO(png)) as picture:
        exact = picture.convert("RGB")
        counted = exact.getcolors(exact.width * exact.height) or []
        frequent = [colour for _, colour in sorted(counted, reverse=True)[:256]]
        palette = Image.new("P", (1, 1))
        palette.putpalette([channel for colour in frequent for channel in colour])
        few = exact.quantize(palette=palette, dither=Image.Dither.NONE)
        few.save(small, "png", optimize=True)
    return small.getvalue()


def main() -> int:
    """Read the command line and take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("downloads", type=Path)
    parser.add_argument("names", nargs="*", default=NAMES, help=", ".join(NAMES))
    arguments = parser.parse_args()
    try:
        programs = install(arguments.downloads)
        with TemporaryDirectory() as folder:
            take(programs, arguments.names, Path(folder))
    except UnavailableError as missing:
        print(missing, file=sys.stderr)
        return 2
    for name in arguments.names:
        print(f"{name}.png: {(PICTURES / f'{name}.png').stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
