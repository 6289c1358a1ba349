"""Tables of frames: `{ position = [900, 0, -20], quaternion = [1, 0, 0, 0] }`."""

from __future__ import annotations

import math
from typing import Annotated, TypeAlias

from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.targets import MM
from rapidsim.station.declared_tables import ReadBy, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class FrameTable:
    """A frame."""

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """[mm]."""
    quaternion: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """Rotation, the scalar first; its length is 1, to 1 %."""


def _frame(reader: Reader, table: Table, path: str, key: str) -> Transform:
    """Read a frame as a transform [m]."""
    path = f"{path}.{key}"
    frame = FrameTable(**values_of(reader, FrameTable, reader.table(table, key, path), path))
    length = math.hypot(*frame.quaternion)
    if abs(length - 1.0) > 1e-2:
        reader.wrong(f"{path}.quaternion", f"its length is {length:.4g}, not 1")
        return Transform.identity()
    return Transform.from_quaternion(frame.quaternion, [x * MM for x in frame.position])


Frame: TypeAlias = Annotated[Transform, ReadBy(_frame)]
