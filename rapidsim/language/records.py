"""RAPID's record types, read from the value classes of `data`."""

from __future__ import annotations

from functools import cache
from typing import get_args, get_type_hints

from rapidsim.language import arc_data, data, option_data, types
from rapidsim.language.record_values import in_brackets
from rapidsim.language.types import Component, Record, Type

RECORD_CLASSES: tuple[type[tuple[object, ...]], ...] = (
    data.Pos,
    data.Orient,
    data.Pose,
    data.ConfData,
    data.ExtJoint,
    data.RobJoint,
    data.RobTarget,
    data.JointTarget,
    data.SpeedData,
    data.ZoneData,
    data.LoadData,
    data.ToolData,
    data.WobjData,
    data.InPosData,
    data.StopPointData,
    data.ProgDisp,
    data.VelData,
    data.AccData,
    data.SingData,
    data.ConfSupData,
    data.MotSetData,
    data.ListItem,
    data.Tasks,
    data.EgmMinMax,
    data.TriggIos,
    data.TriggIosDnum,
    data.TriggStrGo,
    data.WzTemporary,
    data.WzStationary,
    data.RmqHeader,
    arc_data.ArcData,
    arc_data.SeamData,
    arc_data.WeldData,
    arc_data.WeaveData,
    arc_data.ArcTrackData,
    arc_data.OptTrackData,
    arc_data.TrackData,
    option_data.CameraTarget,
    option_data.RestartData,
    option_data.Sensor,
    option_data.SensorVarData,
    option_data.MenuData,
)
"""Every record type RAPID predefines."""

for _python in RECORD_CLASSES:
    _python.__repr__ = in_brackets  # type: ignore[assignment,method-assign]

_ATOMS: dict[object, types.Atomic] = {float: types.NUM, bool: types.BOOL, str: types.STRING}
_NAMES: dict[type, str] = {data.EgmMinMax: "egm_minmax"}


@cache
def record_of(python: type[tuple[object, ...]]) -> Record:
    """The RAPID type of a value class; each class has one `Record`, so identity is equality."""
    hints = get_type_hints(python, include_extras=True)
    components = tuple(Component(name, _type_of(hint)) for name, hint in hints.items())
    return Record(_NAMES.get(python, python.__name__.lower()), components, python)


def _type_of(hint: object) -> Type:
    if hint in _ATOMS:
        return _ATOMS[hint]
    if isinstance(hint, type):
        return record_of(hint)
    metadata = get_args(hint)[1]
    assert isinstance(metadata, types.Atomic)
    return metadata
