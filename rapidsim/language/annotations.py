"""RAPID signatures of library routines as Python annotations.

Positional parameters are required, keyword-only ones are RAPID's optional arguments (default None),
a keyword-only `Switch` is a switch. `InOut[Num]`, `Var[...]` and `Pers[...]` arrive as references.
A first parameter annotated with a protocol of `controller` is passed by the interpreter and is not
part of the signature. Python's `max_time` is RAPID's `MaxTime`; `X | Y` accepts either type.

- Arrays are their own reference: `list[Num]` is `num{*}`, `Annotated[list[Num], Mode.VAR]` is the
  array by reference.
- `AnyType` is `anytype`; with `Only(...)` it accepts fewer types, and the checker names them.
- `Deferred[Bool]` is passed as a function without parameters that evaluates the argument.
- A keyword-only `ArgumentType` is not part of the signature either: its value is the type of the
  argument for the first parameter of type `anytype` or of several types, to distinguish num and
  dnum; that of a second one belongs to the second such parameter.
- `**options: Unpack[SomeTypedDict]` is one argument each, by keyword: those that the row of the
  routine names, optional or not.
- Signals are passed as references to a `Signal`, which names the signal; a signal that no module
  declares is treated as declared with its own name.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Annotated, Any, TypeVar

from rapidsim.language import types
from rapidsim.language.data import ClockState, Signal
from rapidsim.language.error_log import LoggedError
from rapidsim.language.files import OpenFile
from rapidsim.language.messages import Message, Slot
from rapidsim.language.modules import LoadSession
from rapidsim.language.path_events import Trigger, ZoneShape
from rapidsim.language.reference import Reference
from rapidsim.language.sockets import SocketState
from rapidsim.language.symbols import DataName
from rapidsim.values import value_class

T = TypeVar("T")


class ParameterMode(Enum):
    """Passing mode of a parameter."""

    IN = "IN"
    INOUT = "INOUT"
    VAR = "VAR"
    PERS = "PERS"
    REF = "REF"


class Marker(Enum):
    """Special treatment of a parameter by the interpreter."""

    DEFERRED = "deferred"
    """Pass a function that evaluates the argument."""
    ARGUMENT_TYPE = "argument type"
    """Pass the type of another argument."""


@value_class(frozen=True, slots=True)
class Only:
    """Types that a parameter of type anytype accepts, if not all."""

    words: str
    types: tuple[types.Type, ...]


Num = Annotated[float, types.NUM]
Dnum = Annotated[float, types.DNUM]
Bool = Annotated[bool, types.BOOL]
String = Annotated[str, types.STRING]
Switch = Annotated[bool, types.SWITCH]
AnyType = Annotated[Any, types.ANYTYPE]
AnySignal = Annotated[Any, types.ANYTYPE, Only("a signal", types.SIGNALS)]
SignalOrName = Annotated[
    Any, types.ANYTYPE, Only("a signal or a string", (*types.SIGNALS, types.STRING))
]
Packed = Annotated[
    Any, types.ANYTYPE, Only("num, dnum or string", (types.NUM, types.DNUM, types.STRING))
]
OutputValue = Annotated[
    Any, types.ANYTYPE, Only("num, dnum or bool", (types.NUM, types.DNUM, types.BOOL))
]

ConfiguredValue = Annotated[
    Any,
    types.ANYTYPE,
    Only("num, dnum, bool or string", (types.NUM, types.DNUM, types.BOOL, types.STRING)),
]

AioTrigg = Annotated[float, types.Alias("aiotrigg", types.NUM)]
BusState = Annotated[float, types.Alias("busstate", types.NUM)]
CfgDomain = Annotated[float, types.Alias("cfgdomain", types.NUM)]
IoUnitStateNum = Annotated[float, types.Alias("iounit_state", types.NUM)]
SignalOriginNum = Annotated[float, types.Alias("signalorigin", types.NUM)]
BtnRes = Annotated[float, types.Alias("btnres", types.NUM)]
ButtonData = Annotated[float, types.Alias("buttondata", types.NUM)]
Byte = Annotated[float, types.Alias("byte", types.NUM)]
DioNum = Annotated[float, types.Alias("dionum", types.NUM)]
ErrDomain = Annotated[float, types.Alias("errdomain", types.NUM)]
EventTypeNum = Annotated[float, types.Alias("event_type", types.NUM)]
HandlerType = Annotated[float, types.Alias("handler_type", types.NUM)]
ExecLevelNum = Annotated[float, types.Alias("exec_level", types.NUM)]
ErrNum = Annotated[float, types.Alias("errnum", types.NUM)]
ErrStr = Annotated[str, types.Alias("errstr", types.STRING)]
ErrType = Annotated[float, types.Alias("errtype", types.NUM)]
IconData = Annotated[float, types.Alias("icondata", types.NUM)]
IdentNo = Annotated[float, types.Alias("identno", types.NUM)]
IntNum = Annotated[float, types.Alias("intnum", types.NUM)]
TestSignalNum = Annotated[float, types.Alias("testsignal", types.NUM)]
TpNum = Annotated[float, types.Alias("tpnum", types.NUM)]
IntTypes = Annotated[float, types.Alias("inttypes", types.NUM)]
OpCalc = Annotated[float, types.Alias("opcalc", types.NUM)]
OpNum = Annotated[float, types.Alias("opnum", types.NUM)]
SocketStatus = Annotated[float, types.Alias("socketstatus", types.NUM)]
TspStatus = Annotated[float, types.Alias("tsp_status", types.NUM)]
StringDig = Annotated[str, types.Alias("stringdig", types.STRING)]
SymNum = Annotated[float, types.Alias("symnum", types.NUM)]

_OPAQUE = {atom.name: atom for atom in types.OPAQUE}
TaskId = Annotated[object, _OPAQUE["taskid"]]
MecUnit = Annotated[object, _OPAQUE["mecunit"]]
CameraDev = Annotated[Any, _OPAQUE["cameradev"]]
"""The name of a camera in the configuration; None if it is the name of the variable."""
CorrDescr = Annotated[int | None, _OPAQUE["corrdescr"]]
"""The number of a correction generator; None while it is not connected."""
TriggData = Annotated[Trigger | None, _OPAQUE["triggdata"]]
TrapData = Annotated[LoggedError | None, _OPAQUE["trapdata"]]
PathRecId = Annotated[int | None, _OPAQUE["pathrecid"]]
ShapeData = Annotated[ZoneShape | None, _OPAQUE["shapedata"]]
Dir = Annotated[list[str] | None, _OPAQUE["dir"]]
"""An open folder: the names that ReadDir has not returned yet."""
DataPos = Annotated[DataName | None, _OPAQUE["datapos"]]
LoadSessionVar = Annotated[LoadSession | None, _OPAQUE["loadsession"]]
RmqMessage = Annotated[Message | None, _OPAQUE["rmqmessage"]]
RmqSlot = Annotated[Slot | None, _OPAQUE["rmqslot"]]
SocketDev = Annotated[SocketState | None, _OPAQUE["socketdev"]]
TriggMode = Annotated[float, types.Alias("triggmode", types.NUM)]

Clock = Annotated[ClockState, types.CLOCK]
IoDev = Annotated[OpenFile | None, types.IODEV]
RawBytes = Annotated[bytes, types.RAWBYTES]
SignalDi = Annotated[Signal, types.SIGNAL_DI]
SignalDo = Annotated[Signal, types.SIGNAL_DO]
SignalAi = Annotated[Signal, types.SIGNAL_AI]
SignalAo = Annotated[Signal, types.SIGNAL_AO]
SignalGi = Annotated[Signal, types.SIGNAL_GI]
SignalGo = Annotated[Signal, types.SIGNAL_GO]

InOut = Annotated[Reference[T], ParameterMode.INOUT]
Var = Annotated[Reference[T], ParameterMode.VAR]
Pers = Annotated[Reference[T], ParameterMode.PERS]
Ref = Annotated[T, ParameterMode.REF]

Deferred = Annotated[Callable[[], T], Marker.DEFERRED]
ArgumentType = Annotated[types.Type, Marker.ARGUMENT_TYPE]
