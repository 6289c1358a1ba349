"""A megabyte of RAPID logic without moves: `python benchmarks/logic.py [FOLDER]`.

Routines of assignments, branches, loops, calls, texts and signals, made from a seed; all names are
declared, so a check finds no errors. Printed is the processor time of `rapidsim check` in a process
of its own, with and without a run of main. With a folder, the files are left there.
"""

from __future__ import annotations

import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

SIZE = 1_000_000
"""Characters of the text."""
_TINY = 'MODULE tiny\n  PROC main()\n    TPWrite "hello";\n  ENDPROC\nENDMODULE\n'
_NUMS = ("count", "total", "speed", "limit", "station", "part", "row", "column")
_BOOLS = ("ready", "done", "failed", "empty")
_TEXTS = ("message", "label", "line")


def logic(size: int = SIZE, seed: int = 1) -> str:
    """A module of about so many characters."""
    dice = random.Random(seed)
    routines: list[str] = []
    length = 0
    while length < size:
        routines.append(_routine(len(routines), dice))
        length += len(routines[-1])
    calls = "".join(f"    work{number} {number % 7};\n" for number in range(len(routines)))
    data = "".join(f"  VAR num {name}:=1;\n" for name in _NUMS)
    data += "".join(f"  VAR bool {name};\n" for name in _BOOLS)
    data += "".join(f'  VAR string {name}:="";\n' for name in _TEXTS)
    data += "  VAR num table{20};\n  PERS num stored:=0;\n"
    return (
        f"MODULE logic\n{data}  PROC main()\n{calls}  ENDPROC\n{''.join(routines)}"
        "  FUNC num scaled(num value, num factor)\n"
        "    RETURN value*factor/100;\n  ENDFUNC\nENDMODULE\n"
    )


def configuration() -> str:
    """The station file with the signals of the module."""
    kinds = {"di": "di", "do": "do", "gi": "gi"}
    lines = [
        f'{name}{number} = {{ type = "{kind}" }}'
        for name, kind in kinds.items()
        for number in range(8)
    ]
    return "[signals]\n" + "\n".join(lines) + "\n"


def _routine(number: int, dice: random.Random) -> str:
    body = "".join(_statement(dice, 2, number) for _ in range(dice.randrange(8, 20)))
    return (
        f"  ! Station {number}\n  PROC work{number}(num order)\n    VAR num own:=0;\n"
        f'    VAR string part_text:="";\n    own:=order+{number};\n{body}  ENDPROC\n\n'
    )


def _statement(dice: random.Random, depth: int, number: int) -> str:
    indent = "  " * depth
    kind = dice.randrange(14 if depth < 5 else 8)
    num = dice.choice(_NUMS)
    match kind:
        case 0 | 1:
            return f"{indent}{num}:={_value(dice)};\n"
        case 2:
            return f"{indent}table{{{dice.randrange(1, 20)}}}:={_value(dice)};\n"
        case 3:
            text = dice.choice(_TEXTS)
            return f'{indent}{text}:="{num} "+NumToStr({num},{dice.randrange(4)})+part_text;\n'
        case 4:
            return f"{indent}{dice.choice(_BOOLS)}:={_condition(dice)};\n"
        case 5:
            return f"{indent}SetDO do{dice.randrange(8)},{dice.randrange(2)};\n"
        case 6:
            return f"{indent}IF {_condition(dice)} Incr {num};\n"
        case 7:
            callee = dice.randrange(number) if number else None
            if callee is None:
                return f"{indent}stored:=stored+1;\n"
            return f"{indent}work{callee} {_value(dice)};\n"
        case 8 | 9:
            then, other = (_body(dice, depth + 1, number) for _ in range(2))
            return f"{indent}IF {_condition(dice)} THEN\n{then}{indent}ELSE\n{other}{indent}ENDIF\n"
        case 10:
            body = _body(dice, depth + 1, number)
            return f"{indent}FOR i FROM 1 TO {dice.randrange(2, 20)} DO\n{body}{indent}ENDFOR\n"
        case 11:
            body = _body(dice, depth + 1, number)
            return (
                f"{indent}own:=0;\n{indent}WHILE own<{dice.randrange(2, 9)} DO\n"
                f"{indent}  own:=own+1;\n{body}{indent}ENDWHILE\n"
            )
        case 12:
            one, other = (_body(dice, depth + 1, number) for _ in range(2))
            return (
                f"{indent}TEST {num}\n{indent}CASE 1,2:\n{one}{indent}CASE 3:\n{other}"
                f"{indent}DEFAULT:\n{indent}  {dice.choice(_BOOLS)}:=FALSE;\n{indent}ENDTEST\n"
            )
        case _:
            text = dice.choice(_TEXTS)
            return (
                f"{indent}part_text:=StrPart({text},1,{dice.randrange(1, 4)});\n"
                f'{indent}TPWrite "at "+part_text\\Num:={num};\n'
            )


def _body(dice: random.Random, depth: int, number: int) -> str:
    return "".join(_statement(dice, depth, number) for _ in range(dice.randrange(1, 4)))


def _value(dice: random.Random) -> str:
    one, other = dice.choice(_NUMS), dice.choice(_NUMS)
    return dice.choice(
        (
            f"{one}+{dice.randrange(90)}",
            f"({one}-{other})*{dice.randrange(2, 9)}",
            f"scaled({one},{dice.randrange(100)})",
            f"Abs({one})+table{{{dice.randrange(1, 20)}}}",
            f"{one} MOD {dice.randrange(2, 9)}",
            f"Round({one}*0.5\\Dec:={dice.randrange(3)})",
            "own",
        )
    )


def _condition(dice: random.Random) -> str:
    one, other = dice.choice(_NUMS), dice.choice(_NUMS)
    return dice.choice(
        (
            f"{one}>{dice.randrange(50)}",
            f"{one}<={other} AND NOT {dice.choice(_BOOLS)}",
            f"di{dice.randrange(8)}=1",
            f"gi{dice.randrange(8)}>{dice.randrange(9)} OR {dice.choice(_BOOLS)}",
            f"StrLen({dice.choice(_TEXTS)})>{dice.randrange(20)}",
            f"{dice.choice(_BOOLS)}",
        )
    )


def processor_s(folder: Path, name: str, *options: str) -> float:
    """Seconds of processor that a check of a file takes, user and system."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "rapidsim", "check", "--no-cache", *options, name]
    subprocess.run(command, cwd=folder, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Write the files, measure and print."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(sys.argv[1] if len(sys.argv) > 1 else temporary)
        text = logic()
        (folder / "logic.mod").write_text(text)
        (folder / "tiny.mod").write_text(_TINY)
        (folder / "rapidsim.toml").write_text(configuration())
        for options in ((), ("--no-run",)):
            start = min(processor_s(folder, "tiny.mod", *options) for _ in range(3))
            whole = min(processor_s(folder, "logic.mod", *options) for _ in range(3))
            rate = len(text) / 1000.0
            name = " ".join(("check", *options))
            print(
                f"{name:15} {whole:.2f} s, {rate / whole:.0f} KB/s;"
                f" {rate / (whole - start):.0f} KB/s without the start of {start:.2f} s"
            )


if __name__ == "__main__":
    main()
