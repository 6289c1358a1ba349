"""What a text costs grows with its length: twice the text, about twice the work.

Work is counted in calls of functions, Python's own ones too, which is the same in every run.
"""

import contextlib
import io
from collections.abc import Callable
from cProfile import Profile
from pathlib import Path

import pytest

from rapidsim.cli.boundary import run_commands

MOST_GROWTH = 2.3
TARGET = "[[{n},0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"


def lines(count: int, text: str) -> str:
    """A text so many times, one a line; `{n}` is the number of the line."""
    return "\n".join(text.replace("{n}", str(n)) for n in range(count))


def module(body: str = "", *, data: str = "", routines: str = "") -> str:
    main = f"  PROC main()\n{body}\n  ENDPROC"
    return f"MODULE m\n  VAR num x;\n{data}\n{main}\n{routines}\nENDMODULE\n"


def nested(count: int) -> str:
    return module("IF x=1 THEN\n" * count + "ENDIF\n" * count)


def nested_apart(count: int) -> str:
    """Blocks nested to a depth that is allowed, again and again."""
    return module(("IF x=1 THEN\n" * 60 + "x:=2;\n" + "ENDIF\n" * 60) * (count // 60))


ELEMENTS = ",".join
TEXTS: dict[str, tuple[int, Callable[[int], str]]] = {
    "nesting": (400, nested),
    "allowed nesting": (180, nested_apart),
    "nested alternatives": (400, lambda n: module("IF x=1 THEN\nELSE\n" * n + "ENDIF\n" * n)),
    "nested brackets": (400, lambda n: module(f"x:={'(' * n}1{')' * n};")),
    "unclosed blocks": (200, lambda n: module(lines(n, "IF x=1 THEN"))),
    "unclosed blocks with bodies": (150, lambda n: module(lines(n, "IF x=1 THEN\n  x:=2;"))),
    "unclosed blocks of a few": (60, lambda n: module(lines(n, "IF x=1 THEN"))),
    "unclosed loops": (200, lambda n: module(lines(n, "WHILE x=1 DO"))),
    "unopened blocks": (400, lambda n: module(lines(n, "ENDIF"))),
    "unclosed routines": (60, lambda n: module(routines=lines(n, "PROC p{n}()\nx:=1;"))),
    "unclosed blocks of routines": (
        125,
        lambda n: module(routines=lines(n, "PROC p{n}()\nIF TRUE THEN\nx:=1;\nENDPROC")),
    ),
    "branches": (300, lambda n: module(f"IF x=0 THEN\n{lines(n, 'ELSEIF x={n} THEN')}\nENDIF")),
    "cases": (300, lambda n: module(f"TEST x\n{lines(n, 'CASE {n}:')}\nENDTEST")),
    "labels": (300, lambda n: module(lines(n, "l{n}:\nx:=3;\nGOTO l{n};"))),
    "labels that are missing": (150, lambda n: module(lines(n, "l{n}:\nGOTO k{n};"))),
    "statements": (300, lambda n: module(lines(n, "x:=x+1;"))),
    "statements on one line": (300, lambda n: module("x:=1;" * n)),
    "moves": (40, lambda n: module(lines(n, f"MoveL {TARGET},v100,z10,tool0;"))),
    "routines": (120, lambda n: module(routines=lines(n, "PROC p{n}()\nx:=1;\nENDPROC"))),
    "modules": (150, lambda n: lines(n, "MODULE m{n}\nPROC p{n}()\nENDPROC\nENDMODULE")),
    "data": (300, lambda n: module(data=lines(n, "VAR num y{n};"))),
    "records": (150, lambda n: lines(1, "MODULE m\n") + lines(n, RECORD) + "\nENDMODULE\n"),
    "constants of constants": (
        150,
        lambda n: module(data=lines(n, "CONST num c{n}0:=c{n}1;\nCONST num c{n}1:=1;")),
    ),
    "aggregates": (300, lambda n: module(data=f"CONST num y{{{n}}}:=[{ELEMENTS(['1'] * n)}];")),
    "aggregates of names": (
        300,
        lambda n: module(data=f"CONST num one:=1;\nCONST num y{{{n}}}:=[{ELEMENTS(['one'] * n)}];"),
    ),
    "deep aggregates": (300, lambda n: module(data=f"CONST num y:={'[' * n}1{']' * n};")),
    "targets": (150, lambda n: module(data=lines(n, f"CONST robtarget p{{n}}:={TARGET};"))),
    "alternatives without THEN": (40, lambda n: module(lines(n, "IF a\nb;\nELSE\nc;\nENDIF"))),
    "misspelt THEN": (40, lambda n: module(lines(n, "IF x=1 THNE;\nx:=2;\nELSE\nx:=3;\nENDIF"))),
    "errors in a long routine": (
        40,
        lambda n: module(lines(60 * n, "x:=1;") + "\n" + lines(40, "IF x=1\nx:=2;\nELSE\nENDIF")),
    ),
    "errors of types": (200, lambda n: module(lines(n, 'x:="a";'))),
    "errors of syntax": (250, lambda n: module(lines(n, "x:=)(;"))),
    "missing semicolons": (250, lambda n: module(lines(n, "x:=1"))),
    "characters of no language": (120, lambda n: module(lines(n, "x:=1 ? 2;"))),
    "names twice": (200, lambda n: module(data=lines(n, "VAR num y;"))),
    "undeclared data": (
        60,
        lambda n: module(lines(n, "x:=yz{n};"), data=lines(n, "VAR num y{n};")),
    ),
    "undeclared routines": (
        60,
        lambda n: module(lines(n, "q{n};"), routines=lines(n, "PROC p{n}()\nENDPROC")),
    ),
    "comments": (400, lambda n: module(lines(n, "! hello"))),
    "a long comment": (400, lambda n: module("! " + "a" * 100 * n)),
    "a long text": (400, lambda n: module(f'TPWrite "{"a" * 100 * n}";')),
    "open texts": (200, lambda n: module(lines(n, 'TPWrite "a;'))),
    "suppressions": (100, lambda n: module(lines(n, "x:=y; ! rapidsim: ignore[N201] so"))),
    "idle suppressions": (200, lambda n: module(lines(n, "x:=1; ! rapidsim: ignore[N201] so"))),
}
RECORD = "RECORD r{n}\nnum a;\nENDRECORD"
OUTPUTS = ("full", "concise", "json", "sarif", "github", "junit")


def work(text: str, folder: Path, *options: str) -> int:
    """How many functions a check calls."""
    file = folder / "m.mod"
    file.write_text(text, "utf-8")
    profile = Profile()
    with (
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.redirect_stderr(io.StringIO()),
        profile,
    ):
        code = run_commands(["check", str(file), *options])
    assert code in (0, 1)
    # One entry a function: what was called of it.
    return sum(entry.callcount for entry in profile.getstats())


def require_linear(text: Callable[[int], str], count: int, folder: Path, *options: str) -> None:
    """Twice the text costs twice the work, or little more.

    What a process does once in a while counts for nothing, such as compiling a pattern that has
    left Python's cache: it is not there again when the same is measured again.
    """
    growth = 0.0
    for _ in range(2):
        once, twice = (work(text(n), folder, *options) for n in (count, 2 * count))
        growth = twice / once
        if growth <= MOST_GROWTH:
            return
    raise AssertionError(f"twice the text costs {growth:.2f} times the work")


@pytest.fixture(autouse=True, scope="module")
def ready(tmp_path_factory: pytest.TempPathFactory) -> None:
    """What is read once a process does not count."""
    work(module("x:=yy;\nMoveL p,v100,z10,tool0;"), tmp_path_factory.mktemp("ready"))


@pytest.mark.parametrize("name", TEXTS)
def test_a_check_of_twice_the_text(name: str, tmp_path: Path) -> None:
    count, text = TEXTS[name]
    require_linear(text, count, tmp_path, "--no-run")


@pytest.mark.parametrize("output", OUTPUTS)
def test_every_output_of_many_findings(output: str, tmp_path: Path) -> None:
    options = ("--no-run", "--output-format", output, "--no-merge")
    require_linear(lambda n: module(lines(n, 'x:="a";')), 200, tmp_path, *options)


def test_mending_many_findings(tmp_path: Path) -> None:
    require_linear(lambda n: module(lines(n, "x:=1")), 80, tmp_path, "--no-run", "--fix")
