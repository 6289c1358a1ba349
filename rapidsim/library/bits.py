"""Bit functions: bytes 0 to 255 with bits 1 to 8, and dnum with bits 1 to 52.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

import math

from rapidsim.language.annotations import ArgumentType, Bool, Byte, Dnum, InOut, Num
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_NOTINTVAL, rapid_error
from rapidsim.language.types import NUM, Type, resolved
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

BYTE_BITS = 8
DNUM_BITS = 52


def bit_and(bit_data1: Byte, bit_data2: Byte) -> Byte:
    """Bits that are set in both."""
    return float(_byte(bit_data1) & _byte(bit_data2))


def bit_or(bit_data1: Byte, bit_data2: Byte) -> Byte:
    """Bits that are set in one or both."""
    return float(_byte(bit_data1) | _byte(bit_data2))


def bit_x_or(bit_data1: Byte, bit_data2: Byte) -> Byte:
    """Bits that are set in exactly one."""
    return float(_byte(bit_data1) ^ _byte(bit_data2))


def bit_neg(bit_data: Byte) -> Byte:
    """All bits inverted."""
    return float(_byte(bit_data) ^ 0xFF)


def bit_l_sh(bit_data: Byte, shift_steps: Num) -> Byte:
    """Bits shifted left; bits that leave the byte are lost."""
    return float(_byte(bit_data) << _steps(shift_steps, BYTE_BITS) & 0xFF)


def bit_r_sh(bit_data: Byte, shift_steps: Num) -> Byte:
    """Bits shifted right; bits that leave the byte are lost."""
    return float(_byte(bit_data) >> _steps(shift_steps, BYTE_BITS))


def bit_check(bit_data: Byte, bit_pos: Num) -> Bool:
    """Whether a bit is set."""
    return bool(_byte(bit_data) & _mask(bit_pos, BYTE_BITS))


def bit_set(bit_data: InOut[Byte] | InOut[Dnum], bit_pos: Num, *, of: ArgumentType = NUM) -> None:
    """Set a bit to 1."""
    bits = _bits(of)
    bit_data.value = float(_whole(bit_data.value, bits) | _mask(bit_pos, bits))


def bit_clear(bit_data: InOut[Byte] | InOut[Dnum], bit_pos: Num, *, of: ArgumentType = NUM) -> None:
    """Set a bit to 0."""
    bits = _bits(of)
    bit_data.value = float(_whole(bit_data.value, bits) & ~_mask(bit_pos, bits))


def bit_and_dnum(value1: Dnum, value2: Dnum) -> Dnum:
    """Bits that are set in both."""
    return float(_whole(value1, DNUM_BITS) & _whole(value2, DNUM_BITS))


def bit_or_dnum(value1: Dnum, value2: Dnum) -> Dnum:
    """Bits that are set in one or both."""
    return float(_whole(value1, DNUM_BITS) | _whole(value2, DNUM_BITS))


def bit_x_or_dnum(value1: Dnum, value2: Dnum) -> Dnum:
    """Bits that are set in exactly one."""
    return float(_whole(value1, DNUM_BITS) ^ _whole(value2, DNUM_BITS))


def bit_neg_dnum(value: Dnum, *, size: Num | None = None) -> Dnum:
    r"""The lowest \Size bits inverted, the others cleared; all 52 without \Size."""
    mask = (1 << _size(size)) - 1
    return float(~_whole(value, DNUM_BITS) & mask)


def bit_l_sh_dnum(value: Dnum, shift_steps: Num, *, size: Num | None = None) -> Dnum:
    r"""Bits shifted left; bits beyond the lowest \Size ones are lost."""
    mask = (1 << _size(size)) - 1
    return float(_whole(value, DNUM_BITS) << _steps(shift_steps, DNUM_BITS) & mask)


def bit_r_sh_dnum(value: Dnum, shift_steps: Num) -> Dnum:
    """Bits shifted right."""
    return float(_whole(value, DNUM_BITS) >> _steps(shift_steps, DNUM_BITS))


def bit_check_dnum(value: Dnum, bit_pos: Num) -> Bool:
    """Whether a bit is set."""
    return bool(_whole(value, DNUM_BITS) & _mask(bit_pos, DNUM_BITS))


def _bits(of: Type) -> int:
    return BYTE_BITS if resolved(of) == NUM else DNUM_BITS


def _byte(value: float) -> int:
    return _whole(value, BYTE_BITS)


def _whole(value: float, bits: int) -> int:
    if value != math.floor(value):
        raise rapid_error(ERR_NOTINTVAL, f"{value:.7g} is not a whole number and has no bits")
    largest = (1 << bits) - 1
    if not 0 <= value <= largest:
        raise rapid_error(ERR_ARGVALERR, f"{value:.16g} is not within 0..{largest}")
    return int(value)


def _mask(position: float, bits: int) -> int:
    if not (1 <= position <= bits and position == math.floor(position)):
        raise rapid_error(ERR_ARGVALERR, f"there is no bit {position:.7g}; bits are 1..{bits}")
    return 1 << int(position) - 1


def _steps(steps: float, bits: int) -> int:
    if not (0 <= steps <= bits and steps == math.floor(steps)):
        raise rapid_error(ERR_ARGVALERR, f"{steps:.7g} shift steps; 0..{bits} are possible")
    return int(steps)


def _size(size: float | None) -> int:
    return DNUM_BITS if size is None else _steps(size, DNUM_BITS)


BITS = table(
    routine("BitAnd", bit_and),
    routine("BitOr", bit_or),
    routine("BitXOr", bit_x_or),
    routine("BitNeg", bit_neg),
    routine("BitLSh", bit_l_sh),
    routine("BitRSh", bit_r_sh),
    routine("BitCheck", bit_check),
    routine("BitSet", bit_set, does=Trait.INSTANT),
    routine("BitClear", bit_clear, does=Trait.INSTANT),
    routine("BitAndDnum", bit_and_dnum),
    routine("BitOrDnum", bit_or_dnum),
    routine("BitXOrDnum", bit_x_or_dnum),
    routine("BitNegDnum", bit_neg_dnum),
    routine("BitLShDnum", bit_l_sh_dnum),
    routine("BitRShDnum", bit_r_sh_dnum),
    routine("BitCheckDnum", bit_check_dnum),
)
