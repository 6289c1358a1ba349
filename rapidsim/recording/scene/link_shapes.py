"""Link shapes of a robot description, as solid bodies."""

from __future__ import annotations

from types import MappingProxyType

import rerun as rr
from rerun.chunk import Chunk
from rerun.urdf import UrdfTree

from rapidsim.recording.scene.shading import shaded
from rapidsim.values import value_class

_FILLED = rr.components.FillMode.Solid
_SOLID = MappingProxyType(
    {
        "Boxes3D": rr.Boxes3D.from_fields(fill_mode=_FILLED),
        "Capsules3D": rr.Capsules3D.from_fields(fill_mode=_FILLED),
        "Cylinders3D": rr.Cylinders3D.from_fields(fill_mode=_FILLED),
        "Ellipsoids3D": rr.Ellipsoids3D.from_fields(fill_mode=_FILLED),
    }
)
"""Archetypes with fill modes: rerun draws these as wireframes by default."""
_DRAWN = frozenset({"Asset3D", "Mesh3D", *_SOLID})
_COLLISION = "/collision_geometries/"


@value_class(frozen=True, slots=True)
class LoggedShapes:
    """Link frames with a logged shape, and those whose shape could not be read."""

    logged: frozenset[str]
    missing: frozenset[str]


def log_shapes(stream: rr.RecordingStream, tree: UrdfTree) -> LoggedShapes:
    """Log the visible shapes of a description's links.

    Collision shapes are omitted: drawn over the visible ones they flicker.
    """
    chunks = [
        chunk
        for chunk in tree.stream(include_joint_transforms=False)
        if _COLLISION not in chunk.entity_path
    ]
    files = [chunk for chunk in chunks if "Asset3D" in _archetypes(chunk)]
    rr.send_chunks([chunk for chunk in chunks if chunk not in files], recording=stream)
    for chunk in files:
        stream.log(chunk.entity_path, _shaded(chunk), static=True)
    frame_of: dict[str, str] = {}
    drawn_entities: set[str] = set()
    for chunk in chunks:
        frame_of.update(_frame(chunk))
        for archetype in _archetypes(chunk) & _DRAWN:
            drawn_entities.add(chunk.entity_path)
            if archetype in _SOLID:
                stream.log(chunk.entity_path, _SOLID[archetype], static=True)
    shown = {entity: frame for entity, frame in frame_of.items() if _is_visual(entity)}
    return LoggedShapes(
        logged=frozenset(frame for entity, frame in shown.items() if entity in drawn_entities),
        missing=frozenset(frame for entity, frame in shown.items() if entity not in drawn_entities),
    )


def _shaded(chunk: Chunk) -> rr.Asset3D:
    """Return the mesh file of a chunk, with normals."""
    batch = chunk.to_record_batch()
    data = batch.column("Asset3D:blob")[0].values[0].values.to_numpy().tobytes()
    media = batch.column("Asset3D:media_type")[0].as_py()[0]
    return rr.Asset3D(contents=shaded(data), media_type=media)


def _is_visual(entity: str) -> bool:
    return "/visual_geometries/" in entity


def _archetypes(chunk: Chunk) -> set[str]:
    names: list[str] = chunk.to_record_batch().schema.names
    return {name.partition(":")[0] for name in names}


def _frame(chunk: Chunk) -> dict[str, str]:
    """Return the frame of a chunk's entity, by entity."""
    batch = chunk.to_record_batch()
    if "CoordinateFrame:frame" not in batch.schema.names:
        return {}
    frame: str = batch.column("CoordinateFrame:frame")[0].as_py()[0]
    return {chunk.entity_path: frame}
