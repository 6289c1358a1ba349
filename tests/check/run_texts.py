"""Programs with runs of moves, and what goes wrong in them."""

from __future__ import annotations

import random

from exports import export

_WRONG_NUMBERS = ("9E999", "1E39", "0.5", "-0", "99999", "1E-40", "0x1F", "nan", "1 2", "+3", ".5")
_LINES = (
    "    MoveL p9,v200,z1,tool0;",
    "    WaitTime 1;",
    "    SetDO do1,1;",
    "    ! between",
    "",
    "    ConfL\\On;",
    "    SingArea\\Wrist;",
    "    PDispSet [[10,0,0],[1,0,0,0]];",
    "    reg1:=reg1+1;",
    "    IF reg1=1 THEN",
    "    ENDIF",
    "    RETURN;",
    "    again:",
    "    GOTO again;",
    "  ERROR",
    "  ENDPROC",
    "    FOR i FROM 1 TO 3 DO",
    "    ENDFOR",
    '    TPWrite "here";',
    "    VelSet 50,800;",
    "    ! rapidsim: ignore[K601]",
)
_PATHS = ("spiral", "raster", "tilted")


def program(dice: random.Random) -> str:
    """A program with runs of moves, as exports are."""
    count = dice.choice((30, 45, 70))
    form = dice.choice(("inline", "inline", "mixed", "named"))
    text = export(form, dice.choice(_PATHS), count, dice.randrange(1000))
    text = text.replace("SetDO doExtruder,", "SetDO do1,")
    if dice.random() < 0.5:
        text = text.replace("v200", dice.choice(("v50", "vmax", "v7000", "[200,500,5000,1000]")))
    if dice.random() < 0.3:
        text = text.replace("z1,", dice.choice(("z100,", "fine,", "z0,", "zz1,")))
    if dice.random() < 0.3:
        text = text.replace("    ConfL\\Off;\n", "")
    if dice.random() < 0.2:
        text = text.replace(",700.", ",2700.", dice.randrange(1, 40))
    if dice.random() < 0.3:
        text = text.replace(*dice.choice((("tool0", "tMissing"), ("wobj0", "wobj01"))))
    return text


def harmed(text: str, dice: random.Random) -> str:
    """A text in which something has gone wrong, or is only another."""
    match dice.randrange(6):
        case 0:
            at = dice.randrange(len(text))
            return text[:at] + dice.choice('[],;\\.-9 \n"!(xE:') + text[at + dice.randrange(2) :]
        case 1:
            at = dice.randrange(len(text))
            return text[:at] + text[at + dice.choice((1, 1, 1, 5, 200)) :]
        case 2:
            lines = text.split("\n")
            at = dice.randrange(len(lines))
            lines[at : at + dice.randrange(2)] = [dice.choice(_LINES)]
            return "\n".join(lines)
        case 3:
            lines = text.split("\n")
            one, other = dice.randrange(len(lines)), dice.randrange(len(lines))
            lines[one] = lines[other]
            return "\n".join(lines)
        case 4:
            numbers = [k for k, character in enumerate(text) if character == ","]
            at = dice.choice(numbers) + 1
            stop = min(text.index(mark, at) for mark in ",];" if mark in text[at:])
            return text[:at] + dice.choice(_WRONG_NUMBERS) + text[stop:]
        case _:
            lines = text.split("\n")
            at, length = dice.randrange(len(lines)), dice.choice((1, 2, 30))
            moved = lines[at : at + length]
            del lines[at : at + length]
            at = dice.randrange(len(lines) + 1)
            lines[at:at] = moved
            return "\n".join(lines)
