"""Bodies of an arm's links, from its description or from the user's files.

Collision shapes if the description has them, else visual shapes. Each piece of a mesh is replaced
by its convex hull. Links that no joint of the arm moves (a rod, the finger of a gripper) and shapes
in unsupported formats are omitted and reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from rapidsim.collisions import shape
from rapidsim.collisions.meshes.read import read_mesh
from rapidsim.collisions.meshes.triangles import Triangles
from rapidsim.collisions.shape import Shape
from rapidsim.files import InputError, input_text
from rapidsim.frames.euler import Convention, rotation_from_euler
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import LinkMeshes, Robot
from rapidsim.motion.robot.urdf_text import plain_urdf
from rapidsim.values import value_class

BASE = 0
"""Number of the link that does not move."""
_MOST_M = 100.0
_LEAST_LINK_M, _MOST_LINK_M = 0.005, 10.0


@value_class(frozen=True, slots=True, eq=False)
class LinkShape:
    """A shape fixed to one link."""

    number: int
    """Number of joints of the arm that move it."""
    shape: Shape
    """Shape in the frame of the link."""


@value_class(frozen=True, slots=True, eq=False)
class LinkShapes:
    """Bodies of an arm."""

    links: tuple[LinkShape, ...]
    """From base to flange; links without a body are omitted."""
    remarks: tuple[str, ...] = ()
    """Remarks on parts of the arm that are not checked."""


def link_shapes(robot: Robot) -> LinkShapes:
    """Return the bodies of an arm; empty without a description, which is reported."""
    if robot.meshes is not None:
        return _from_meshes(robot.meshes, _at_zero(robot))
    if robot.urdf is None:
        return LinkShapes((), (f"{robot.name} has no link shapes: its collisions are not checked",))
    return _from_urdf(robot.urdf, tuple(joint.name for joint in robot.joints))


@lru_cache(maxsize=8)
def _from_urdf(file: Path, joint_names: tuple[str, ...]) -> LinkShapes:
    text, _ = plain_urdf(file, input_text(file))
    root = ElementTree.fromstring(text)
    remarks: list[str] = []
    by_number: dict[int, list[Shape]] = {}
    frames = _frames(root, joint_names)
    for link in root.iter("link"):
        name = link.get("name", "")
        bodies = list(link.iter("collision")) or list(link.iter("visual"))
        if name not in frames:
            remarks += (
                [f"{name} is not moved by any joint of the arm: not checked"] if bodies else []
            )
            continue
        number, frame = frames[name]
        for body in bodies:
            try:
                own = _geometry(body.find("geometry"), file)
            except (InputError, ValueError) as mistake:
                reason = mistake.message if isinstance(mistake, InputError) else "no sizes"
                remarks.append(f"the shape of {name} cannot be read and is not checked: {reason}")
                continue
            if own is not None:
                by_number.setdefault(number, []).append(own.moved(frame @ _origin(body)))
    links = tuple(
        LinkShape(number, shape.union(found)) for number, found in sorted(by_number.items())
    )
    return LinkShapes(links, tuple(remarks))


@lru_cache(maxsize=8)
def _from_meshes(meshes: LinkMeshes, at_zero: tuple[tuple[float, ...], ...]) -> LinkShapes:
    """Return the bodies in files, for the poses of links with all joints at zero, row by row.

    Raises:
        InputError: If a file cannot be read, or cannot be a link.
    """
    links = []
    for number, (file, unit_m, place) in enumerate(
        zip(meshes.files, meshes.units_m, at_zero, strict=True)
    ):
        mesh = read_mesh(file, file.parent)
        size_m = unit_m * float(np.ptp(mesh.vertices, axis=0).max())
        if not _LEAST_LINK_M <= size_m <= _MOST_LINK_M:
            raise InputError(
                f"{file} would be {1e3 * size_m:.6g} mm long", "give the unit that it was drawn in"
            )
        own = shape.hull_of_each_piece(Triangles(unit_m * mesh.vertices, mesh.faces, mesh.closed))
        base_from_link = np.array(place).reshape(3, 4)
        moved = Transform(base_from_link[:, :3], base_from_link[:, 3]).inverse()
        # With joints at zero, links are parallel to the base, for any frame of the shapes.
        if not meshes.in_base:
            moved = Transform(moved.rotation, np.zeros(3))
        links.append(LinkShape(number, own.moved(moved)))
    return LinkShapes(tuple(links))


def _at_zero(robot: Robot) -> tuple[tuple[float, ...], ...]:
    links = robot.kinematics.link_frames(np.zeros(len(robot.joints)))
    frames = [np.eye(4)[:3], *np.concatenate([links.rotation, links.translation[..., None]], -1)]
    return tuple(tuple(frame.ravel().tolist()) for frame in frames)


def shapes_of_meshes(robot: Robot, meshes: LinkMeshes) -> Robot:
    """Return an arm with shapes from files, which are read here.

    Raises:
        InputError: If a file cannot be read, or cannot be a link.
    """
    found = replace(robot, meshes=meshes)
    link_shapes(found)
    return found


def _frames(
    root: ElementTree.Element, joint_names: Sequence[str]
) -> dict[str, tuple[int, Transform]]:
    """Return, by link, the number of joints that move it and its pose on the last moved link."""
    joints = {}
    for joint in root.findall("joint"):
        child, parent = joint.find("child"), joint.find("parent")
        if child is not None and parent is not None:
            joints[child.get("link", "")] = (joint, parent.get("link", ""))
    frames: dict[str, tuple[int, Transform]] = {}

    def frame(link: str, depth: int = 0) -> tuple[int, Transform] | None:
        if link in frames:
            return frames[link]
        if link not in joints:
            found: tuple[int, Transform] | None = (BASE, Transform.identity())
        else:
            joint, parent = joints[link]
            found = None
            if joint.get("name") in joint_names:
                found = (joint_names.index(joint.get("name", "")) + 1, Transform.identity())
            elif joint.get("type") == "fixed" and depth < 100:
                above = frame(parent, depth + 1)
                found = above and (above[0], above[1] @ _origin(joint))
        if found is not None:
            frames[link] = found
        return found

    for link in root.iter("link"):
        frame(link.get("name", ""))
    return frames


def _origin(tag: ElementTree.Element) -> Transform:
    origin = tag.find("origin")
    if origin is None:
        return Transform.identity()
    turn = rotation_from_euler(_numbers(origin.get("rpy", "0 0 0"), 3), Convention.RPY)
    return Transform(turn, _numbers(origin.get("xyz", "0 0 0"), 3))


def _geometry(geometry: ElementTree.Element | None, file: Path) -> Shape | None:
    """Return a body of a link; None if it has no geometry of a supported kind.

    Raises:
        InputError: If the file of a mesh cannot be read.
        ValueError: If a size is missing or invalid.
    """
    tag = next(iter(geometry), None) if geometry is not None else None
    if tag is None:
        return None
    match tag.tag:
        case "box":
            return shape.box(_sizes(tag.get("size", ""), 3))
        case "sphere":
            return shape.sphere(float(_sizes(tag.get("radius", ""), 1)[0]))
        case "cylinder" | "capsule":
            (radius,), (length,) = (_sizes(tag.get(key, ""), 1) for key in ("radius", "length"))
            make = shape.cylinder if tag.tag == "cylinder" else shape.capsule
            return make(float(radius), float(length))
        case "mesh":
            name = tag.get("filename", "")
            if "://" in name and not name.startswith("file://"):
                raise InputError(f"`{name}` can only be resolved in its ROS workspace")
            # ROS stores descriptions and meshes in two folders of one package.
            room = file.absolute().parent.parent
            mesh = read_mesh(file.parent / name.removeprefix("file://"), room)
            scale = _sizes(tag.get("scale", "1 1 1"), 3)
            return shape.hull_of_each_piece(
                Triangles(mesh.vertices * scale, mesh.faces, mesh.closed)
            )
        case _:
            return None


def _sizes(text: str, count: int) -> Array:
    sizes = _numbers(text, count)
    if not (sizes > 0.0).all():
        raise ValueError
    return sizes


def _numbers(text: str, count: int) -> Array:
    numbers = np.array([float(word) for word in text.split()])
    if len(numbers) != count or not (np.abs(numbers) < _MOST_M).all():
        raise ValueError
    return numbers
