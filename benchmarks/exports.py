"""Programs as CAM and printing systems export them, from a seed.

    python benchmarks/exports.py FORM PATH COUNT FILE [SEED]

FORM is `inline` (the target in the move), `named` (a CONST for each target, then moves by name) or
`mixed` (inline, with a SetDO every 50 moves); PATH is `spiral`, `raster` or `tilted`. All poses are
in reach of an IRB 4600-45/2.05, the default of `Forms` and `scale.py`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

FORMS = ("inline", "named", "mixed")
PATHS = ("spiral", "raster", "tilted")
ROBOT = "irb4600-45-2.05"
_STEP = 2.0
"""Between two targets [mm]."""
_EXTERNAL = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def main() -> None:
    """Write one export."""
    form, path, count, file, *seed = sys.argv[1:]
    text = export(form, path, int(count), int(seed[0]) if seed else 0)
    Path(file).write_text(text, encoding="ascii")


def export(form: str, path: str, count: int, seed: int = 0) -> str:
    """The text of a module whose main makes `count` moves [mm] along a path."""
    targets = [
        f"[[{x:.3f},{y:.3f},{z:.3f}],[{a:.6f},{b:.6f},{c:.6f},{d:.6f}],[0,0,0,0],{_EXTERNAL}]"
        for x, y, z, a, b, c, d in poses(path, count, seed).tolist()
    ]
    declared = "".join(_declared(targets)) if form == "named" else ""
    return (
        f"MODULE export\n{declared}  PROC main()\n    ConfL\\Off;\n"
        f"{''.join(_moves(targets, form))}  ENDPROC\nENDMODULE\n"
    )


def poses(path: str, count: int, seed: int = 0) -> np.ndarray:
    """Position [mm] and quaternion of each target, one a row: (count, 7)."""
    random = np.random.default_rng(seed)
    along = _STEP * np.arange(count)
    if path == "raster":
        # Lines of 400 mm, there and back, 2 mm apart; after 150 of them the next layer.
        line, on_line = np.divmod(along, 400.0)
        x = np.where(line % 2 == 0, on_line, 400.0 - on_line)
        layer, row = np.divmod(line, 150.0)
        xyz = np.column_stack([x - 200.0, 150.0 - 2.0 * row, 0.2 * layer])
    else:
        # Out and in again between radius 60 and 220, 3 mm a turn.
        angle = np.zeros(count)
        radius = 60.0 + 160.0 * (1.0 - np.abs(1.0 - (along / 90_000.0) % 2.0))
        angle = np.cumsum(_STEP / radius)
        xyz = np.column_stack(
            [radius * np.cos(angle), radius * np.sin(angle), 0.4 * np.floor(angle / 200.0)]
        )
    xyz += np.array([1150.0, 0.0, 700.0]) + random.uniform(-0.02, 0.02, (count, 3))
    # The tool looks down: half a turn about y; tilted, up to 12 degrees about x and y.
    tilt = np.zeros((count, 2))
    if path == "tilted":
        phase = along[:, None] / np.array([900.0, 700.0])
        tilt = np.radians(12.0) * np.sin(phase)
    half = tilt / 2.0
    w = np.cos(half[:, 0]) * np.cos(half[:, 1])
    x_, y_ = np.sin(half[:, 0]) * np.cos(half[:, 1]), np.cos(half[:, 0]) * np.sin(half[:, 1])
    z_ = np.sin(half[:, 0]) * np.sin(half[:, 1])
    # (w, x, y, z) times (0, 0, 1, 0).
    turned = np.column_stack([-y_, -z_, w, x_])
    return np.hstack([xyz, turned])


def _declared(targets: list[str]) -> Iterator[str]:
    for number, target in enumerate(targets, 1):
        yield f"  CONST robtarget p{number}:={target};\n"


def _moves(targets: list[str], form: str) -> Iterator[str]:
    for number, target in enumerate(targets, 1):
        if form == "mixed" and number % 50 == 0:
            yield f"    SetDO doExtruder,{number // 50 % 2};\n"
        where = f"p{number}" if form == "named" else target
        way = "MoveJ" if number == 1 else "MoveL"
        zone = "fine" if number == len(targets) else "z1"
        yield f"    {way} {where},v200,{zone},tool0\\WObj:=wobj0;\n"


if __name__ == "__main__":
    main()
