"""Random command lines with `--format json`, of all commands that print JSON and their options."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from rapidsim.cli.group import commands

GOOD = """MODULE good
  CONST robtarget a:=[[450,-100,400],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL Offs(a,0,30,0),v200,fine,tool0;
    n:=1/n;
  ERROR
    IF ERRNO=ERR_OUTOFBND TRYNEXT;
  ENDPROC
ENDMODULE
"""
FAILS = "MODULE fails\n  VAR num n;\n  PROC main()\n    n:=1/n;\n  ENDPROC\nENDMODULE\n"
BROKEN = "MODULE broken\nPROC main()\nn:=1;\nFOO x;\nIF n=1 THEN\nENDPROC\nENDMODULE\n"
ENDLESS = """MODULE endless
  PROC main()
    VAR num k;
    WHILE TRUE DO
      k:=k+1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
POINTS = "x,y,z\n374,0,600\n374,50,600\n374,80,580\n"
STATION = '[robot]\nmodel = "irb120"\n'
FILES: Mapping[str, bytes] = {
    "good.mod": GOOD.encode(),
    "fails.mod": FAILS.encode(),
    "broken.mod": BROKEN.encode(),
    "endless.mod": ENDLESS.encode(),
    "binary.mod": bytes(range(256)) * 20,
    "empty.mod": b"",
    "points.csv": POINTS.encode(),
    "bad.csv": b"x,y\nabc,\xff\n1\n",
    "station.toml": STATION.encode(),
    "bad.toml": b"[robot\nmodel =",
    "wrong.toml": b'[robot]\nmodle = "irb120"\n[signals]\ndi = 3\n',
    "answers.txt": b"1\nyes\n",
    "run.json": b'{"schema": 3, "moves": [], "events": [], "time_s": 0, "end": "ended"}',
    "journal.jsonl": b'{"a": 1}\nnot json\n',
}
VALUES = (
    *("", "0", "-1", "1", "2.5", "nan", "inf", "1e400", "abc", "1,2,3", "0,0,0,0,30,0", "1,0,0,0"),
    *("374,0,630", "0,0,1,0", "irb120", "irb12", "rvm1", "kr10", "no such", "auto", "K6", "ZZZ"),
    *("main", "nothing", "T_ROB1", "time_s < 100", "1 +", "errors = 0", "\N{SNOWMAN}", "x\x1b[31m"),
    *(*FILES, "missing.mod", "folder", "folder/missing/x.csv", ".", "/dev/null", "-"),
    *("out.rrd", "out.csv", "out.html", "out.jsonl", "out.prof", "out", "good.mod:5", "forever"),
)
NOT_TRIED = frozenset({"--format", "--watch", "--view", "--allow-network", "-j"})
"""Options that are in each line, open a window or a port, or take a process a call."""
PLAUSIBLE: Mapping[str, tuple[str, ...]] = {
    "--robot": ("irb120", "irb1600", "rvm1"),
    "--station": ("station.toml",),
    "--joints": ("0,0,0,0,30,0", "10,20,30,40,50,60"),
    "--position": ("374,0,630", "9000,0,0"),
    "--quaternion": ("0.7071068,0,0.7071068,0",),
    "--twist": ("1,2,3,4,5,6",),
    "--tool": ("0,0,100", "tGrip"),
    "--line": ("374,0,630,374,50,630",),
    "--conf": ("0,0,0,0",),
    "--select": ("K6", "F4,E1"),
    "--ignore": ("S9",),
    "--extend-select": ("S9",),
    "--task": ("T_ROB1",),
    "--proc": ("main",),
    "--assert": ("time_s < 100", "errors_dropped = 0"),
    "--io": ("station.toml",),
    "--answers": ("answers.txt",),
    "--record": ("out.rrd",),
    "--trace": ("out.csv", "out.json"),
    "--report": ("out.html",),
    "--events": ("out.jsonl",),
    "--plots": ("out",),
    "--profile": ("out.prof",),
    "--home": ("folder",),
    "--output": ("out.json",),
    "--program": ("good.mod",),
    "--baseline": ("known.json",),
    "--break": ("good.mod:5",),
}


PROGRAMS = ("good.mod", "good.mod", "good.mod", "fails.mod", "broken.mod", "endless.mod")
FITTING: Mapping[str, tuple[str, ...]] = {
    "robots": ("irb120", "rvm1", "irb460"),
    "follow": ("points.csv",),
    "calibrate": ("good.csv", "points.csv"),
}


@dataclass(frozen=True)
class Case:
    words: tuple[str, ...]
    command: str
    """Its words, such as `kin fk`."""


def machine_commands() -> Iterator[tuple[tuple[str, ...], click.Command]]:
    """The commands that have a format json, with their words."""
    context = click.Context(commands)
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command is not None
        members = command.commands.items() if isinstance(command, click.Group) else ()
        for words, member in ((name,), command), *(((name, sub), one) for sub, one in members):
            if any(_prints_json(one) for one in member.params):
                yield words, member


def _prints_json(parameter: click.Parameter) -> bool:
    is_format = "--format" in parameter.opts
    return (
        is_format and isinstance(parameter.type, click.Choice) and "json" in parameter.type.choices
    )


def write_files(folder: Path) -> None:
    for name, data in FILES.items():
        (folder / name).write_bytes(data)
    (folder / "folder").mkdir(exist_ok=True)


def cases(seed: int, count: int) -> Iterator[Case]:
    """So many command lines."""
    known = list(machine_commands())
    for number in range(count):
        draw = random.Random(f"{seed} {number}")
        words, command = known[number % len(known)]
        yield Case(tuple(_line(draw, words, command)), " ".join(words))


def _line(draw: random.Random, words: tuple[str, ...], command: click.Command) -> list[str]:
    options = [one for one in command.params if isinstance(one, click.Option)]
    arguments = [one for one in command.params if isinstance(one, click.Argument)]
    parts: list[list[str]] = []
    for option in options:
        wanted = (option.required and draw.random() < 0.9) or draw.random() < 0.12
        if wanted and NOT_TRIED.isdisjoint(option.opts):
            parts.append(_option(draw, option))
    for argument in arguments:
        several = argument.nargs == -1
        count = draw.choice((0, 1, 1, 1, 2)) if several else int(draw.random() < 0.9)
        parts += [[_path(draw, words[0])] for _ in range(count)]
    if draw.random() < 0.08:
        parts.append(
            [draw.choice(("--bogus", "--fromat", "-x", "--repotr", "--", "-h", "--version"))]
        )
    if words[0] == "run" and draw.random() < 0.8:
        parts.append(["--no-record"])
    if words[0] in {"run", "diff"}:
        parts.append(["--max-time", "5"])
    draw.shuffle(parts)
    # A lone `--` makes paths of what follows.
    json = ["--format", "json"] if draw.random() < 0.8 else ["--format=json"]
    return [*words, *json, *(word for part in parts for word in part)]


def _option(draw: random.Random, option: click.Option) -> list[str]:
    name = draw.choice(option.opts)
    if option.is_flag:
        return [name]
    if draw.random() < 0.03:
        return [name]
    likely = PLAUSIBLE.get(option.opts[0], ("1", "0.5", "10"))
    if draw.random() < 0.7 and not isinstance(option.type, click.Choice):
        return [name, draw.choice(likely)]
    return [name, _value(draw, option.type)]


def _value(draw: random.Random, kind: Any) -> str:
    if isinstance(kind, click.Choice) and draw.random() < 0.8:
        return str(draw.choice(list(kind.choices)))
    return draw.choice(VALUES)


def _path(draw: random.Random, command: str) -> str:
    if draw.random() < 0.75:
        return draw.choice(FITTING.get(command, PROGRAMS))
    return draw.choice(VALUES)
