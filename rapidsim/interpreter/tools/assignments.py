"""Values that a debugger sets: data of a running routine or of its module, root or in part."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from types import FrameType
from typing import Any

from rapidsim.analysis.literals import Value
from rapidsim.interpreter.runtime.arrays import assign_array
from rapidsim.interpreter.runtime.references import with_component
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    global_data,
    local_variable,
    parts_of,
    value_at,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Box, Reference
from rapidsim.language.symbols import DataName, Symbols
from rapidsim.library.text import parsed_value, value_text


def assign(path: str, text: str, frame: FrameType, symbols: Symbols) -> str:
    """Set data to a value.

    Args:
        path: Data with indices and components: `n`, `p10.trans.x`, `a{i,2}`.
        text: The value in source notation, such as `[1,0,0]`.
        frame: The frame of the routine whose scope applies.
        symbols: Access to the data of the task's modules.

    Returns:
        The new value in source notation.

    Raises:
        NotShownError: If there are no such data, they are constant, or the text is no value of
            their type.
    """
    old, of = value_at(path, frame)
    new = parsed_value(text.strip(), of, old)
    if new is None:
        raise NotShownError(f"`{text}` is no {of.name}")
    name, parts = parts_of(path, frame)
    root = with_part(value_at(name, frame)[0], parts, new)
    variable = local_variable(name, frame)
    if variable is not None:
        _set_local(*variable, root)
    else:
        symbol = global_data(name, frame)
        if symbol is None or symbol.module is None:
            raise NotShownError(f"`{name}` cannot be set")
        try:
            where = DataName(symbol.name, symbol.module.name.text)
            symbols.write(symbol.name, symbol.type, where, root)
        except RapidError as error:
            raise NotShownError(error.message) from None
    return value_text(new, of)


def with_part(root: Value, parts: Sequence[int], new: Value) -> Value:
    """Return a value with one of its parts, at any depth, replaced."""
    if not parts:
        return new
    first, *rest = parts
    if isinstance(root, list):
        copy = list(root)
        copy[first] = with_part(root[first], rest, new)
        return copy
    return with_component(root, (first,), with_part(root[first], rest, new))


def _set_local(frame: FrameType, key: str, index: int | None, value: Value) -> None:
    """Set a variable of a routine: the Python variable `key` of its frame, or an element of it."""
    held: Any = frame.f_locals[key]
    if index is not None:
        held[index] = value
    elif isinstance(held, list):
        assign_array(held, value)
    elif isinstance(held, Box) or hasattr(held, "value"):
        reference: Reference[Any] = held
        reference.value = value
    else:
        if isinstance(held, int) and not isinstance(held, bool):
            # Generated code relies on it.
            if value % 1.0:
                raise NotShownError(f"`{key}` is always root in this program")
            value = int(value)
        frame.f_locals[key] = value
        if sys.version_info < (3, 13):
            # Until then `f_locals` is a copy of the variables.
            ctypes.pythonapi.PyFrame_LocalsToFast(ctypes.py_object(frame), ctypes.c_int(0))
