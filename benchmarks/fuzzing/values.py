"""Values as RAPID writes them: ordinary ones a controller would see, and odd ones.

Odd are infinities, minus zero, what single precision cannot hold, empty and full strings,
quaternions of zeros, zero lengths, data of nothing but large numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

from fuzzing.dice import Dice
from rapidsim.language.types import ArrayOf, Atomic, Record, Type, resolved

UNUSED = "[9E9,9E9,9E9,9E9,9E9,9E9]"
TOO_LARGE = "(1E38*10)"
"""For single precision; expressions are more precise."""
INFINITE = f"({'*'.join(9 * ['1E38'])})"
NOT_A_NUMBER = f"({INFINITE}-{INFINITE})"

_NUMBERS = ("0", "1", "2", "3", "5", "10", "50", "100", "0.5", "0.25", "-1", "-3", "45", "90")
_ODD_NUMBERS = (
    *("0", "-0", "1E38", "-1E38", "3.402823E38", "1E-38", "1E-45", "9E9", "0.1", "-32769"),
    *("65536", "16777217", "4294967296", "1E9", "360", "1E-6"),
)
_ODD_DNUMS = (
    *_ODD_NUMBERS,
    "1.7E308",
    "-1.7E308",
    "5E-324",
    "9007199254740993",
    "4503599627370496",
)
_TEXTS = (
    *('"a"', '"1"', '"2.5"', '"TRUE"', '"[1,2,3]"', '"abc def"', '"HOME:"', '"HOME:/a.txt"'),
    *('"a.txt"', '"HOME:/folder"', '"T_ROB1"', '"num"', '"do1"', '"FF"', '"12345678901234567890"'),
)
_ODD_TEXTS = (
    *('""', '" "', f'"{80 * "x"}"', '"\\0D\\0A"', '"\\00"', '"\\1B[2J"', '"\\""\\""'[:0] + '""""'),
    *('"\\\\"', '"1E400"', '"-0"', '"[[["', '"%"', '"../out"', '"HOME:/../../x"', '"/etc/passwd"'),
    *('"é€"', '"TEMP:x"', '"."', '"999999999999999999999999"', '"1E38"', '"nan"', '"inf"'),
)
_ORIENTATIONS = ("[0,0,1,0]", "[0,0,1,0]", "[0,0,1,0]", "[0,0.7071068,0.7071068,0]", "[1,0,0,0]")
_ODD_ORIENTATIONS = ("[0,0,0,0]", "[1,1,1,1]", "[1E38,0,0,0]", "[-0,-0,-1,0]", "[0,1E-30,0,0]")
_LOAD = "[1,[0,0,30],[1,0,0,0],0,0,0]"


def literal(of: Type, dice: Dice) -> str:
    """A value of a type; of an open dimension there are one to four parts."""
    match resolved(of):
        case ArrayOf(element=element, dimensions=(size, *inner)):
            part: Type = ArrayOf(element, tuple(inner)) if inner else element
            parts = size if size is not None else dice.randint(1, 4)
            return f"[{','.join(literal(part, dice) for _ in range(parts))}]"
        case Record(name=name, components=components):
            odd = dice.odd()
            if odd and name == "orient":
                return dice.of(_ODD_ORIENTATIONS)
            if not odd and (make := _ORDINARY.get(name)) is not None:
                return make(dice)
            return f"[{','.join(literal(part.type, dice) for part in components)}]"
        case Atomic(name="bool"):
            return dice.of(("TRUE", "FALSE"))
        case Atomic(name="string"):
            return dice.of(_ODD_TEXTS if dice.odd() else _TEXTS)
        case Atomic(name="dnum"):
            return dice.of(_ODD_DNUMS if dice.odd() else _NUMBERS)
        case _:
            return dice.of(_ODD_NUMBERS if dice.odd() else _NUMBERS)


def _pos(dice: Dice) -> str:
    if dice.chance(0.3):
        return dice.of(("[0,0,0]", "[0,0,100]", "[10,20,30]"))
    return f"[{dice.randint(400, 800)},{dice.randint(-300, 300)},{dice.randint(400, 800)}]"


def _pose(dice: Dice) -> str:
    trans = dice.of(("[0,0,0]", "[0,0,100]", "[10,0,0]"))
    return f"[{trans},{dice.of(('[1,0,0,0]', '[1,0,0,0]', '[0,0,0,1]'))}]"


def _target(dice: Dice) -> str:
    where = f"[{dice.randint(450, 750)},{dice.randint(-300, 300)},{dice.randint(450, 750)}]"
    turns = dice.of(("[0,0,0,0]", "[0,0,0,0]", "[0,0,0,0]", "[-1,0,-1,0]"))
    return f"[{where},{dice.of(_ORIENTATIONS)},{turns},{UNUSED}]"


def _joints(dice: Dice) -> str:
    return f"[{','.join(str(dice.randint(-40, 40)) for _ in range(4))},{dice.randint(30, 60)},0]"


_ORDINARY: dict[str, Callable[[Dice], str]] = {
    "pos": _pos,
    "orient": lambda dice: dice.of(_ORIENTATIONS),
    "pose": _pose,
    "confdata": lambda dice: dice.of(("[0,0,0,0]", "[-1,0,-1,0]", "[0,0,0,1]")),
    "extjoint": lambda dice: dice.of((UNUSED, UNUSED, "[0,0,0,0,0,0]")),
    "robjoint": _joints,
    "robtarget": _target,
    "jointtarget": lambda dice: f"[{_joints(dice)},{UNUSED}]",
    "speeddata": lambda dice: f"[{dice.of((50, 200, 1000))},500,5000,1000]",
    "zonedata": lambda dice: dice.of(
        ("[FALSE,10,15,15,1.5,15,1.5]", "[TRUE,0,0,0,0,0,0]", "[FALSE,50,75,75,7.5,75,7.5]")
    ),
    "loaddata": lambda dice: _LOAD,
    "tooldata": lambda dice: f"[TRUE,{_pose(dice)},{_LOAD}]",
    "wobjdata": lambda dice: f'[FALSE,TRUE,"",{_pose(dice)},[[0,0,0],[1,0,0,0]]]',
    "tasks": lambda dice: dice.of(('["T_ROB1"]', '["T_ROB2"]')),
}


def sizes(dice: Dice, dimensions: int) -> tuple[int, ...]:
    """How many elements an array has in each dimension; small ones."""
    return tuple(dice.of((1, 2, 3, 3, 4)) for _ in range(dimensions))


def places(of: ArrayOf) -> list[str]:
    """All indices of an array: `{1,2}`."""
    ranges = [range(1, (size or 1) + 1) for size in of.dimensions]
    return [f"{{{','.join(map(str, indices))}}}" for indices in product(*ranges)]
