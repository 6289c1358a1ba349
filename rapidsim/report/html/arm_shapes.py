"""Data with which a page draws an arm at any joints: its kinematic chain and link shapes.

A link turns about one axis by a sum of joints, for rods couple them, or slides. Shapes are those
that ship with the catalogue. They are made of convex bodies, and of each the page gets the
outermost corners.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from itertools import chain
from math import degrees, isfinite, radians
from pathlib import Path

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.colours import LIGHT
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.motion.robot.robot import Robot
from rapidsim.shipped import shipped

_MM = 1000.0
_TRIED = 0.5
"""[rad]"""
_EXACT = 1e-6
_DIRECTIONS = 40
"""Corners of a body that are kept: the furthest in so many directions."""
_SMALLEST = 0.035
"""Share of the arm's size; smaller bodies, such as screws, are omitted."""
_WELDED_M = 1e-5
_TURN_DEG = 360.0
_NUMBERS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""Types of numbers in a glTF file, by its code."""


def arm_data(robot: Robot) -> dict[str, object] | None:
    """Links, limits and shapes as JSON values: mm and degrees; None for an arm of another kind.

    Values of a joint that slides are mm, as RAPID has them.
    """
    links = _links(robot)
    if links is None:
        return None
    return {
        "links": links,
        "limits": [
            [_bound(joint.lower, -_TURN_DEG), _bound(joint.upper, _TURN_DEG)]
            for joint in robot.joints
        ],
        "units": [with_unit("", joint.measure) for joint in robot.joints],
        "bodies": list(_bodies(robot, len(links) - 1)),
    }


def _bound(limit: float, without: float) -> float:
    """A limit [rad] in degrees; `without` for an axis that has no limit."""
    return round(degrees(limit), 3) if isfinite(limit) else without


def _links(robot: Robot) -> list[dict[str, object]] | None:
    """Poses of the links in their predecessors, the first in base; the last is the flange."""
    count = len(robot.joints)
    at_zero = _relative(robot, np.zeros(count))
    tried = [_relative(robot, _TRIED * one) for one in np.eye(count)]
    turns = np.array([_turns(at_zero, one) for one in tried]) / _TRIED
    ways = np.array([one.translation - at_zero.translation for one in tried]) / _TRIED
    largest = np.argmax(np.linalg.norm(turns, axis=-1), axis=0)
    axes = turns[largest, np.arange(turns.shape[1])]
    lengths = np.linalg.norm(axes, axis=-1, keepdims=True)
    axes = np.where(lengths > _EXACT, axes / np.maximum(lengths, _EXACT), [0.0, 0.0, 1.0])
    shares = np.einsum("jki,ki->kj", turns, axes)
    posture = np.linspace(0.3, 0.7, count) * (-1.0) ** np.arange(count)
    turned = _about(axes, shares @ posture)
    slid = at_zero.translation + np.einsum("jki,j->ki", ways, posture)
    expected = Transform(at_zero.rotation @ turned, slid)
    if not np.allclose(expected.matrix, _relative(robot, posture).matrix, atol=_EXACT):
        return None
    return [
        {
            "turn": np.round(at_zero.rotation[k], 9).ravel().tolist(),
            "place": np.round(_MM * at_zero.translation[k], 3).tolist(),
            "axis": np.round(axes[k], 9).tolist(),
            "shares": np.round(shares[k], 6).tolist(),
            **_slide(ways[:, k]),
        }
        for k in range(len(at_zero))
    ]


def _relative(robot: Robot, joints: Array) -> Transform:
    """Poses of each link and of the flange in the link before it."""
    links = robot.kinematics.link_frames(joints)
    flange = robot.kinematics.forward(joints)
    frames = Transform(
        np.concatenate([np.eye(3)[None], links.rotation, flange.rotation[None]]),
        np.concatenate([np.zeros((1, 3)), links.translation, flange.translation[None]]),
    )
    return frames[:-1].inverse() @ frames[1:]


def _slide(offsets: Array) -> dict[str, object]:
    """Displacement [mm] of a link in its predecessor per degree of each joint, if it slides.

    Args:
        offsets: Shape (n, 3) [m] per rad.
    """
    if np.abs(offsets).max() < _EXACT:
        return {}
    return {"slide": np.round(_MM * radians(1.0) * offsets, 6).tolist()}


def _turns(at_zero: Transform, moved: Transform) -> Array:
    """By which rotation vectors (k, 3) [rad] links turn in the ones before from joints at 0."""
    return vector_from_rotation(np.swapaxes(at_zero.rotation, -1, -2) @ moved.rotation)


def _about(axes: Array, angles: Array) -> Array:
    """Rotations (k, 3, 3) about axes (k, 3) by angles (k,) [rad]."""
    x, y, z = axes.T
    zero = np.zeros(len(axes))
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(-1, 3, 3)
    sine, cosine = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    turned: Array = np.eye(3) + sine * cross + (1.0 - cosine) * cross @ cross
    return turned


def _bodies(robot: Robot, link_count: int) -> Iterator[dict[str, object]]:
    """Bodies of the base and the links of an arm of the catalogue; of others none."""
    found = [*_own(robot)] if robot.meshes else [*_catalogue_shapes(robot, link_count)]
    size = max((float(np.ptp(corners, axis=0).max()) for _, _, corners in found), default=0.0)
    for link, colour, corners in found:
        if float(np.ptp(corners, axis=0).max()) >= _SMALLEST * size:
            yield {"link": link, "colour": colour, "corners": outermost(corners)}


def outermost(corners: Array) -> list[int]:
    """The outermost of corners (k, 3) [m] of a convex body, in mm, one after the other."""
    kept = np.unique(np.argmax(corners @ _directions().T, axis=0))
    places: list[int] = np.rint(_MM * corners[kept]).astype(np.int64).ravel().tolist()
    return places


def _own(robot: Robot) -> Iterator[tuple[int, str, Array]]:
    """Link, colour and corners (k, 3) [m] of the shapes that the user has."""
    for link in link_shapes(robot).links:
        for part in link.shape.parts:
            yield link.number, LIGHT.arm, part.points


def _catalogue_shapes(robot: Robot, link_count: int) -> Iterator[tuple[int, str, Array]]:
    """Shapes of an arm of the catalogue: link, colour and triangles."""
    folder = shipped("robots").resolve()
    if robot.urdf is None or folder not in robot.urdf.resolve().parents:
        return
    text = robot.urdf.read_text(encoding="utf-8")
    names = dict(re.findall(r'<link name="(\w+)">\s*<visual>.*filename="([^"]+)"', text))
    for k, link in enumerate(("base_link", *(f"link_{k}" for k in range(1, link_count + 1)))):
        if link in names:
            for body in _read(robot.urdf.parent / names[link]):
                yield k, *body


@cache
def _directions() -> Array:
    """Directions (k, 3) spread evenly."""
    k = np.arange(_DIRECTIONS) + 0.5
    up, around = 1.0 - 2.0 * k / _DIRECTIONS, np.pi * (1.0 + 5.0**0.5) * k
    level = np.sqrt(1.0 - up**2)
    directions: Array = np.stack([level * np.cos(around), level * np.sin(around), up], axis=-1)
    return directions


def _read(file: Path) -> list[tuple[str, Array]]:
    """Colour and corners (k, 3) [m] of each body of a glTF file that `scripts/` made."""
    data = file.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    head, numbers = json.loads(data[20 : 20 + length]), data[28 + length :]

    def table(index: int, width: int) -> Array:
        accessor = head["accessors"][index]
        view = head["bufferViews"][accessor["bufferView"]]
        offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        kind = _NUMBERS[accessor["componentType"]]
        return np.frombuffer(numbers, kind, width * accessor["count"], offset).reshape(-1, width)

    return [
        (_colour(head["materials"][part["material"]]), body)
        for part in chain.from_iterable(mesh["primitives"] for mesh in head["meshes"])
        for body in connected_bodies(
            table(part["attributes"]["POSITION"], 3), table(part["indices"], 1)
        )
    ]


def _colour(material: dict[str, dict[str, list[float]]]) -> str:
    """A colour as in a style sheet: sRGB, while glTF colours are linear."""
    light = np.array(material["pbrMetallicRoughness"]["baseColorFactor"][:3])
    seen = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return "#" + "".join(f"{round(255 * value):02x}" for value in seen.tolist())


def connected_bodies(corners: Array, triangles: npt.NDArray[np.number]) -> list[Array]:
    """The bodies of a mesh: corners that triangles hold together."""
    places, of_corner = np.unique(np.rint(corners / _WELDED_M), axis=0, return_inverse=True)
    held = of_corner.ravel()[triangles.ravel().astype(np.int64)].reshape(-1, 3)
    body = np.arange(len(places))
    while True:
        least = body.copy()
        np.minimum.at(least, held.ravel(), np.repeat(body[held].min(axis=1), 3))
        least = least[least]
        if np.array_equal(least, body):
            break
        body = least
    return [places[body == one] * _WELDED_M for one in np.unique(body)]
