"""Raw bytes: what is packed comes out again, byte for byte as written here."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from library_controller import RecordingController, call

from rapidsim.language import error_numbers as errors
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import single
from rapidsim.language.types import DNUM, NUM, STRING

PACKED: list[tuple[object, dict[str, object], str]] = [
    (5.0, {"hex1": True}, "05"),
    (8.0, {"int_x": 1.0}, "08"),
    (-2.0, {"int_x": -1.0}, "fe"),
    (258.0, {"int_x": 2.0}, "0201"),
    (258.0, {"int_x": 2.0, "network": True}, "0102"),
    (-1.0, {"int_x": -4.0}, "ffffffff"),
    (4294967295.0, {"int_x": 4.0}, "ffffffff"),
    (1.0, {"int_x": 8.0, "network": True}, "0000000000000001"),
    (1.5, {"float4": True}, "0000c03f"),
    (1.5, {"float4": True, "network": True}, "3fc00000"),
    ("AB", {"ascii_": True}, "4142"),
    (65.0, {"ascii_": True}, "41"),
]


@pytest.mark.parametrize(("value", "options", "expected"), PACKED)
def test_packing(value: object, options: dict[str, object], expected: str) -> None:
    raw = Box(b"")
    call("PackRawBytes", value, raw, 1.0, **options)
    assert raw.value.hex() == expected
    back: Box[Any] = Box(value)
    read = {**options, "ascii_": float(len(raw.value))} if "ascii_" in options else options
    call("UnpackRawBytes", raw, 1.0, back, of=STRING if isinstance(value, str) else DNUM, **read)
    assert back.value == value


@given(st.floats(width=32, allow_nan=False, allow_infinity=False).filter(lambda x: abs(x) > 1e-37))
def test_floats_come_back(x: float) -> None:
    raw = Box(b"")
    call("PackRawBytes", x, raw, 3.0, float4=True)
    number: Box[float] = Box(0.0)
    call("UnpackRawBytes", raw, 3.0, number, float4=True, of=NUM)
    assert number.value == x


def test_a_num_keeps_24_bits_of_an_integer() -> None:
    raw = Box((2**24 + 1).to_bytes(4, "little"))
    number: Box[float] = Box(0.0)
    call("UnpackRawBytes", raw, 1.0, number, int_x=4.0, of=NUM)
    assert number.value == single(2.0**24 + 1.0) == 2.0**24
    call("UnpackRawBytes", raw, 1.0, number, int_x=4.0, of=DNUM)
    assert number.value == 2.0**24 + 1.0


def test_positions_length_and_copies() -> None:
    raw = Box(b"")
    call("PackRawBytes", 1.0, raw, 4.0, hex1=True)
    assert raw.value == b"\0\0\0\x01"
    call("PackRawBytes", 2.0, raw, 2.0, hex1=True)
    assert raw.value == b"\0\x02\0\x01"
    assert call("RawBytesLen", raw) == 4.0
    other = Box(b"xx")
    call("CopyRawBytes", raw, 2.0, other, 2.0)
    assert other.value == b"x\x02\0\x01"
    call("CopyRawBytes", raw, 4.0, other, 1.0, no_of_bytes=1.0)
    assert other.value == b"\x01\x02\0\x01"
    call("ClearRawBytes", other, from_index=3.0)
    assert other.value == b"\x01\x02"
    call("ClearRawBytes", other)
    assert call("RawBytesLen", other) == 0.0


def test_files_hold_raw_bytes() -> None:
    controller = RecordingController()
    device: Box[Any] = Box(None)
    controller.call("Open", "HOME:/raw.bin", device, write=True)
    controller.call("WriteRawBytes", device, Box(b"\x01\x02\x03"), no_of_bytes=2.0)
    controller.call("Close", device)
    raw = Box(b"old")
    controller.call("Open", "HOME:/raw.bin", device, read=True)
    controller.call("ReadRawBytes", device, raw)
    assert raw.value == b"\x01\x02"


REFUSED: list[tuple[object, float, dict[str, object], str]] = [
    (256.0, 1.0, {"hex1": True}, "256 is not an integer of 1 byte"),
    (-1.0, 1.0, {"int_x": 2.0}, "-1 is not an integer of 2 bytes"),
    (0.5, 1.0, {"int_x": -2.0}, "0.5 is not a signed integer of 2 bytes"),
    (1.0, 1.0, {"int_x": 3.0}, "3 is not an integer type"),
    (1.0, 0.0, {"hex1": True}, "there is no byte 0; bytes are 1..1024"),
    (1.0, 1024.0, {"int_x": 2.0}, "byte 1025 lies beyond the 1024"),
    (1.0, 1.0, {}, "a number is packed with"),
    ("a", 1.0, {"hex1": True}, "a string is packed with"),
    (1e300, 1.0, {"float4": True}, "does not fit into 4 bytes"),
]


@pytest.mark.parametrize(("value", "start", "options", "message"), REFUSED)
def test_refusal(value: object, start: float, options: dict[str, object], message: str) -> None:
    with pytest.raises(RapidError, match=message) as caught:
        call("PackRawBytes", value, Box(b""), start, **options)
    assert caught.value.errno == errors.ERR_ARGVALERR


def test_bytes_that_are_not_there_are_refused() -> None:
    with pytest.raises(RapidError, match="no 4 bytes from 2 in raw bytes of length 3"):
        call("UnpackRawBytes", Box(b"abc"), 2.0, Box(0.0), float4=True, of=NUM)
    other = Box(b"")
    call("CopyRawBytes", Box(b"abc"), 3.0, other, 1.0, no_of_bytes=0.0)
    assert other.value == b""
    for start, count in ((1.0, -1.0), (1.0, 4.0), (3.0, 2.0)):
        with pytest.raises(RapidError, match=f"no {count:g} bytes from {start:g} in raw bytes"):
            call("CopyRawBytes", Box(b"abc"), start, other, 1.0, no_of_bytes=count)
    with pytest.raises(RapidError, match=r"there is no byte 1\.5; bytes are 1\.\.1024"):
        call("CopyRawBytes", Box(b"abc"), 1.5, other, 1.0)
    with pytest.raises(RapidError, match="are no number"):
        call("UnpackRawBytes", Box(b"\xff" * 4), 1.0, Box(0.0), float4=True, of=NUM)
