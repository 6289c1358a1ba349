"""The key `shapes` of [robot]: the user's own link meshes in place of the built-in shapes.

The folder has one file per link, `base_link` and `link_1` to the last, in any mesh format; other
files in it are ignored, except meshes with other names.
"""

from __future__ import annotations

from pathlib import Path

from rapidsim.collisions.link_shapes import shapes_of_meshes
from rapidsim.collisions.meshes.read import IN_METRES, KINDS
from rapidsim.files import InputError, entries_of, require_inside
from rapidsim.motion.robot.robot import LinkMeshes, Robot
from rapidsim.station.units import LengthUnit


def with_meshes(arm: Robot, folder: Path, unit_m: float | None, *, in_base: bool) -> Robot:
    """Return an arm with the shapes of a folder; read once, so that no run fails on a bad file.

    Args:
        arm: The arm.
        folder: The folder with the files.
        unit_m: Length unit of the files [m]; None if the format defines it.
        in_base: Whether all meshes are drawn in the base frame, with all axes at zero.

    Raises:
        InputError: If there is not exactly one readable file per link.
    """
    names = ("base_link", *(f"link_{number + 1}" for number in range(len(arm.joints))))
    found: dict[str, Path] = {}
    meshes = [one for one in entries_of(folder) if one.suffix.lower() in KINDS]
    for file in require_inside(meshes, [folder]):
        name = file.stem.lower()
        if name not in names:
            raise InputError(
                f"{file}: {arm.name} has no such link",
                f"its links are {names[0]}, {names[1]} to {names[-1]}",
            )
        if name in found:
            raise InputError(f"{folder} has two files for {name}", "remove one of them")
        if unit_m is None and file.suffix.lower() not in IN_METRES:
            raise InputError(
                f"{file} does not state its unit",
                f'give `shapes-unit = "mm"`, or another of {", ".join(LengthUnit)}',
            )
        found[name] = file
    if missing := [name for name in names if name not in found]:
        raise InputError(
            f"{folder} has no file for {', '.join(missing)}",
            f"{arm.name} needs {len(names)}, such as {names[0]}.stl and {names[1]}.stl",
        )
    files = tuple(found[name] for name in names)
    units = tuple(
        1.0 if unit_m is None or file.suffix.lower() in IN_METRES else unit_m for file in files
    )
    return shapes_of_meshes(arm, LinkMeshes(files, units, in_base))
