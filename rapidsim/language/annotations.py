"""How a library routine writes its RAPID signature: as Python annotations.

Positional parameters are required, keyword-only ones are RAPID's optional arguments (default None),
a keyword-only `Switch` is a switch. `InOut[Num]`, `Var[...]` and `Pers[...]` arrive as references.
A first parameter annotated with a protocol of `controller` is given by the interpreter and is not
part of the signature. Python's `max_time` is RAPID's `MaxTime`.
"""

from __future__ import annotations

from enum import Enum
from typing import Annotated, Any, TypeVar

from rapidsim.language import types
from rapidsim.language.reference import Reference

T = TypeVar("T")


class Mode(Enum):
    """How an argument is passed."""

    IN = "IN"
    INOUT = "INOUT"
    VAR = "VAR"
    PERS = "PERS"
    REF = "REF"


Num = Annotated[float, types.NUM]
Dnum = Annotated[float, types.DNUM]
Bool = Annotated[bool, types.BOOL]
String = Annotated[str, types.STRING]
Switch = Annotated[bool, types.SWITCH]
AnyType = Annotated[Any, types.ANYTYPE]

Byte = Annotated[float, types.Alias("byte", types.NUM)]
DioNum = Annotated[float, types.Alias("dionum", types.NUM)]
ErrNum = Annotated[float, types.Alias("errnum", types.NUM)]

InOut = Annotated[Reference[T], Mode.INOUT]
Var = Annotated[Reference[T], Mode.VAR]
Pers = Annotated[Reference[T], Mode.PERS]
