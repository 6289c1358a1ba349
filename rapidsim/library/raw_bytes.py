r"""Raw bytes: packing numbers and texts into them, and unpacking them.

Raw bytes are up to 1024 bytes; their length is the highest byte that was written. Numbers are
little-endian, with \Network big-endian.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "rawbytes",
"PackRawBytes", "UnpackRawBytes".
"""

from __future__ import annotations

import math
import struct
from typing import Literal

from rapidsim.language.annotations import (
    ArgumentType,
    IntTypes,
    IoDev,
    Num,
    Packed,
    RawBytes,
    Switch,
    Var,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.reference import Reference
from rapidsim.language.single_precision import LARGEST_SINGLE, single
from rapidsim.language.types import DNUM, NUM, STRING, resolved
from rapidsim.library.files import opened_device
from rapidsim.library.table import routine, table
from rapidsim.library.text import checked

MOST_BYTES = 1024
_ENCODING = "iso-8859-1"


def pack_raw_bytes(
    value: Packed,
    raw_data: Var[RawBytes],
    start_index: Num,
    *,
    network: Switch = False,
    hex1: Switch = False,
    int_x: IntTypes | None = None,
    float4: Switch = False,
    ascii_: Switch = False,
) -> None:
    """Pack a number or a text into raw bytes, from a position on."""
    if isinstance(value, str):
        if not ascii_:
            raise rapid_error(ERR_ARGVALERR, r"a string is packed with \ASCII")
        packed = value.encode(_ENCODING, "replace")
    elif int_x is not None:
        packed = _integer_bytes(value, int_x, network)
    elif float4:
        if abs(value) > LARGEST_SINGLE:
            raise rapid_error(ERR_ARGVALERR, f"{value:g} does not fit into 4 bytes")
        packed = struct.pack(">f" if network else "<f", value)
    elif hex1 or ascii_:
        packed = _integer_bytes(value, 1.0, network)
    else:
        raise rapid_error(ERR_ARGVALERR, r"a number is packed with \Hex1, \IntX, \Float4 or \ASCII")
    _put(raw_data, start_index, packed)


def unpack_raw_bytes(
    raw_data: Var[RawBytes],
    start_index: Num,
    value: Var[Packed],
    *,
    network: Switch = False,
    hex1: Switch = False,
    int_x: IntTypes | None = None,
    float4: Switch = False,
    ascii_: Num | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Unpack a number or a text from raw bytes, from a position on."""
    if resolved(of) == STRING:
        if ascii_ is None:
            raise rapid_error(ERR_ARGVALERR, r"a string is unpacked with \ASCII")
        text = _take(raw_data.value, start_index, int(ascii_)).decode(_ENCODING)
        value.value = checked(text)
        return
    if int_x is not None:
        size = _size(int_x)
        packed = _take(raw_data.value, start_index, size)
        number = float(int.from_bytes(packed, _order(network), signed=int_x < 0.0))
    elif float4:
        packed = _take(raw_data.value, start_index, 4)
        (number,) = struct.unpack(">f" if network else "<f", packed)
        if not math.isfinite(number):
            raise rapid_error(ERR_ARGVALERR, f"the 4 bytes from {start_index:g} are no number")
    elif hex1 or ascii_ is not None:
        number = float(_take(raw_data.value, start_index, 1)[0])
    else:
        raise rapid_error(
            ERR_ARGVALERR, r"a number is unpacked with \Hex1, \IntX, \Float4 or \ASCII"
        )
    value.value = number if resolved(of) == DNUM else single(number)


def clear_raw_bytes(raw_data: Var[RawBytes], *, from_index: Num | None = None) -> None:
    """Clear raw bytes, all of them or from a position on."""
    kept = 0 if from_index is None else _index(from_index)
    raw_data.value = raw_data.value[:kept]


def copy_raw_bytes(
    from_raw_data: Var[RawBytes],
    from_index: Num,
    to_raw_data: Var[RawBytes],
    to_index: Num,
    *,
    no_of_bytes: Num | None = None,
) -> None:
    """Copy a number of bytes, or all bytes from a position on."""
    source = from_raw_data.value
    count = len(source) - _index(from_index) if no_of_bytes is None else int(no_of_bytes)
    _put(to_raw_data, to_index, _take(source, from_index, count))


def raw_bytes_len(raw_data: Var[RawBytes]) -> Num:
    """The number of bytes in use."""
    return float(len(raw_data.value))


def write_raw_bytes(
    io_device: Var[IoDev], raw_data: Var[RawBytes], *, no_of_bytes: Num | None = None
) -> None:
    """Write raw bytes to a file, all of them or only the first ones."""
    count = len(raw_data.value) if no_of_bytes is None else int(no_of_bytes)
    opened_device(io_device).write(_take(raw_data.value, 1.0, count))


def read_raw_bytes(
    io_device: Var[IoDev], raw_data: Var[RawBytes], *, time: Num | None = None
) -> None:
    r"""Read a file, 1024 bytes at most; \Time limits a wait, and a file never causes one."""
    del time
    raw_data.value = opened_device(io_device).read(MOST_BYTES)


def _put(raw_data: Reference[bytes], position: float, packed: bytes) -> None:
    start = _index(position)
    end = start + len(packed)
    if end > MOST_BYTES:
        raise rapid_error(ERR_ARGVALERR, f"byte {end} lies beyond the {MOST_BYTES} of raw bytes")
    before = raw_data.value[:start].ljust(start, b"\0")
    raw_data.value = before + packed + raw_data.value[end:]


def _take(raw: bytes, position: float, count: int) -> bytes:
    start = _index(position)
    if count < 0 or start + count > len(raw):
        raise rapid_error(
            ERR_ARGVALERR, f"no {count} bytes from {start + 1} in raw bytes of length {len(raw)}"
        )
    return raw[start : start + count]


def _index(position: float) -> int:
    if not (1 <= position <= MOST_BYTES and position == math.floor(position)):
        raise rapid_error(
            ERR_ARGVALERR, f"there is no byte {position:.7g}; bytes are 1..{MOST_BYTES}"
        )
    return int(position) - 1


def _order(network: bool) -> Literal["big", "little"]:
    return "big" if network else "little"


def _size(int_type: float) -> int:
    if abs(int_type) not in (1.0, 2.0, 4.0, 8.0):
        raise rapid_error(ERR_ARGVALERR, f"{int_type:.7g} is not an integer type")
    return int(abs(int_type))


def _integer_bytes(value: float, int_type: float, network: bool) -> bytes:
    size = _size(int_type)
    try:
        if value == math.floor(value):
            return int(value).to_bytes(size, _order(network), signed=int_type < 0.0)
    except OverflowError:
        pass
    sign = "a signed " if int_type < 0.0 else "an "
    raise rapid_error(
        ERR_ARGVALERR, f"{value:.16g} is not {sign}integer of {size} byte{'s' * (size > 1)}"
    )


_FORM = r"\Hex1|\IntX|\Float4|\ASCII"

RAW_BYTES = table(
    routine("PackRawBytes", pack_raw_bytes, rf"Value RawData \Network StartIndex {_FORM}"),
    routine("UnpackRawBytes", unpack_raw_bytes, rf"RawData \Network StartIndex Value {_FORM}"),
    routine("ClearRawBytes", clear_raw_bytes),
    routine("CopyRawBytes", copy_raw_bytes),
    routine("RawBytesLen", raw_bytes_len),
    routine("WriteRawBytes", write_raw_bytes),
    routine("ReadRawBytes", read_raw_bytes),
)
