"""EGM's messages as bytes: those of the format's own library, and whatever else may come."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.egm.codec import DecodeError, decode, encode
from rapidsim.egm.messages import PATH_CORRECTION, ROBOT, SENSOR

# Written by protobuf 7.36.2 from the definitions that abb-robot-client 0.4.0 carries.
JOINTS = bytes.fromhex(
    "0a040807180312380a3609000000000000f83f0900000000000000c009000000000000000009000000000000104009"
    "0000000000001440090000000000001940"
)
POSE = bytes.fromhex(
    "0a0508ac021803124512430a1b090000000000407f4011000000000000000019000000000000f0bf12240900000000"
    "0000f03f1100000000000000001900000000000000002100000000000000001a38123609000000000000f03f090000"
    "0000000000400900000000000008400900000000000010400900000000000014400900000000000018402209110000"
    "000000000840"
)
CORRECTION = bytes.fromhex(
    "0a0408011804121f0a1b09000000000000000011000000000000f03f1900000000000000401001"
)


def test_what_clients_write_is_read_and_written_alike() -> None:
    joints = decode(SENSOR, JOINTS)
    assert joints == {
        "header": {"seqno": 7, "mtype": 3},
        "planned": {"joints": {"joints": [1.5, -2.0, 0.0, 4.0, 5.0, 6.25]}},
    }
    pose = decode(SENSOR, POSE)
    assert pose["header"]["seqno"] == 300
    assert pose["planned"]["cartesian"]["pos"] == {"x": 500.0, "y": 0.0, "z": -1.0}
    assert pose["speedRef"]["cartesians"]["value"] == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert pose["RAPIDtoRobot"]["dnum"] == [3.0]
    correction = decode(PATH_CORRECTION, CORRECTION)
    assert correction["pathCorr"] == {"pos": {"x": 0.0, "y": 1.0, "z": 2.0}, "age": 1}
    for of, fields, data in (
        (SENSOR, joints, JOINTS),
        (SENSOR, pose, POSE),
        (PATH_CORRECTION, correction, CORRECTION),
    ):
        assert encode(of, fields) == data


def test_fields_of_later_generations_are_skipped() -> None:
    later = bytes.fromhex("a80601b2060161b90600000000000000f0bd0600000000")
    assert decode(SENSOR, later + JOINTS) == decode(SENSOR, JOINTS)


def test_doubles_may_be_packed() -> None:
    packed = encode(SENSOR, {}) + bytes.fromhex("12140a120a10000000000000f03f0000000000000040")
    assert decode(SENSOR, packed)["planned"]["joints"]["joints"] == [1.0, 2.0]


@pytest.mark.parametrize(
    "data",
    [
        b"\x0a",
        b"\x0a\x05\x08",
        b"\xff" * 11,
        b"\x0b",
        b"\x08\x01",
        bytes.fromhex("120e120c0a0a09000000000000f03f"),
        bytes.fromhex("12 0d 0a 0b 09 000000000000f07f"),
        bytes.fromhex("12 06 0a 04 0a 02 00 00"),
    ],
)
def test_what_is_no_message_is_refused(data: bytes) -> None:
    # Cut off, endless, of an unknown type, of another type, a required field missing, a number
    # that is infinite, doubles cut in two.
    with pytest.raises(DecodeError):
        decode(SENSOR, data)


@examples(300)
@given(st.binary(max_size=200))
def test_no_bytes_do_more_than_be_refused(data: bytes) -> None:
    for of in (SENSOR, PATH_CORRECTION, ROBOT):
        try:
            decode(of, data)
        except DecodeError:
            continue


@examples(100)
@given(st.integers(0, len(POSE) - 1), st.integers(0, 255))
def test_no_spoilt_byte_does_either(at: int, byte: int) -> None:
    try:
        decode(SENSOR, POSE[:at] + bytes([byte]) + POSE[at + 1 :])
    except DecodeError:
        return
