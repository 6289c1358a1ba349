"""`rapidsim run --break`: the debugger at a pseudo-terminal, as a person uses it."""

import os
import signal
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from cli_helper import rapidsim

from rapidsim.cli.tools import debugger
from rapidsim.dap.program_files import ProgramFiles

if sys.platform == "win32":
    pytest.skip("a pseudo-terminal is needed, which Windows has not", allow_module_level=True)

import pty

PROMPT = b"(rapid) "
CTRL_C = "\x03"

CELL = """MODULE cell
  RECORD part
    num width;
    string label;
  ENDRECORD
  CONST num sizes{3} := [1, 2, 3];
  PERS num count := 3;
  LOCAL VAR part parts{2};
  VAR intnum beat;
  PROC main()
    VAR num Own := 0.1;
    CONST num local_most := 4;
    CONNECT beat WITH at_beat;
    ITimer 0.5, beat;
    bump Own, parts{2}.width \\label := "b";
    bump count, Own;
    WaitTime 0.6;
    risky;
    %"risky"%;
  ENDPROC

  PROC bump(INOUT num v, INOUT num w \\string label)
    v := v + 1;
    w := v;
  ENDPROC

  TRAP at_beat
    Incr count;
    IDelete beat;
  ENDTRAP

  PROC risky()
    VAR num d;
    d := 1 / d;
    TPWrite "behind";
  ERROR
    d := sizes{2};
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
LINE = {text.strip(): number for number, text in enumerate(CELL.splitlines(), 1)}


def debug(
    folder: Path, breaks: list[str], *commands: str, text: str = CELL
) -> tuple[list[str], str, int]:
    """Type commands at the prompts, then `q`.

    Returns:
        What was answered to each command, the first answer being to the start of the program; what
        was shown behind the last prompt; the exit code.
    """
    (folder / "cell.mod").write_text(text)
    options = [word for one in breaks for word in ((one,) if "--" in one else ("--break", one))]
    arguments = [sys.executable, "-m", "rapidsim", "run", "cell.mod", "--no-record", *options]
    process, terminal = pty.fork()
    if process == 0:
        # A background job ignores it, and so do its children.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        os.chdir(folder)
        os.environ.update(TERM="dumb", COLUMNS="80", PYTHONIOENCODING="utf-8")
        for variable in ("CI", "PYTEST_CURRENT_TEST"):
            os.environ.pop(variable, None)
        os.execv(sys.executable, arguments)
    waiting = [*commands]
    shown = b""
    asked = 0
    while True:
        try:
            some = os.read(terminal, 65536)
        except OSError:  # Linux says so when the program has ended; macOS reads nothing.
            break
        if not some:
            break
        shown += some
        while shown.count(PROMPT) > asked:
            asked += 1
            os.write(terminal, (waiting.pop(0) if waiting else "q").encode() + b"\n")
            if waiting and waiting[0] == CTRL_C:
                time.sleep(1.0)
                os.write(terminal, waiting.pop(0).encode())
    os.close(terminal)
    _, status = os.waitpid(process, 0)
    parts = shown.decode().replace("\r\n", "\n").split(PROMPT.decode())
    answers = [
        part.partition("\n")[2].strip() if number else part for number, part in enumerate(parts)
    ]
    return answers[: len(commands) + 1], answers[-1], os.waitstatus_to_exitcode(status)


def at(statement: str, routine: str) -> str:
    return f"> cell.mod:{LINE[statement]} in {routine}\n-> {statement}"


@pytest.mark.process
def test_it_stops_on_the_line_and_shows_rapid_values(tmp_path: Path) -> None:
    line = LINE["v := v + 1;"]
    answers, _, code = debug(
        tmp_path,
        [f"cell.mod:{line}"],
        *("w", "p v", "p LABEL", "a", "p sizes", "p parts{2}", "p count", "p tool0.tframe.trans"),
        *("p own", "u", "p own", "p local_most", "own", "p sizes{local_most}", "p 1 + 1", "p nope"),
    )
    assert answers[0].endswith(f"{at('v := v + 1;', 'bump')}\n")
    assert "n: next statement" in answers[0]
    call = 'bump Own, parts{2}.width \\label := "b";'
    main = f"cell.mod:{LINE[call]} in main\n-> {call}"
    assert answers[1:9] == [
        f"{main}\n{at('v := v + 1;', 'bump')}",
        "0.1",
        '"b"',
        'v = 0.1\nw = 0\nlabel = "b"',
        "[1,2,3]",
        '[0,""]',
        "3",
        "[0,0,0]",
    ]
    assert answers[9:] == [
        "*** `own` is not the name of data here",
        f"> {main}",
        "0.1",
        "4",
        "0.1",
        "*** index 4 is outside the array, which has 1 to 3",
        "2",
        "*** `nope` is not the name of data here",
    ]
    assert code == 130


@pytest.mark.process
def test_steps_go_from_statement_to_statement(tmp_path: Path) -> None:
    start = LINE['bump Own, parts{2}.width \\label := "b";']
    answers, end, code = debug(
        tmp_path, [str(start)], *("s", "n", "n", "s", "p w", "r", "s", "n", "r", "c")
    )
    assert answers[1:-1] == [
        at("v := v + 1;", "bump"),
        at("w := v;", "bump"),
        at("bump count, Own;", "main"),
        at("v := v + 1;", "bump"),
        "1.1",
        at("WaitTime 0.6;", "main"),
        at("Incr count;", "at_beat"),
        at("IDelete beat;", "at_beat"),
        at("risky;", "main"),
    ]
    assert "cell.mod on ABB IRB 1600-6/1.2 ended as programmed after 0.600 s" in end
    assert code == 0


@pytest.mark.process
def test_an_error_is_seen_and_its_clause_can_be_entered(tmp_path: Path) -> None:
    answers, _, code = debug(
        tmp_path,
        [f"CELL.MOD:{LINE['d := 1 / d;']}"],
        *("n", "n", "n", "n", "p d", "c"),
    )
    assert answers[1:6] == [
        f"error: division by zero\n{at('d := 1 / d;', 'risky')}",
        at("d := sizes{2};", "the ERROR clause of risky"),
        at("TRYNEXT;", "the ERROR clause of risky"),
        at('TPWrite "behind";', "risky"),
        "2",
    ]
    assert code == 130


@pytest.mark.process
def test_it_steps_into_a_module_that_the_program_loads(tmp_path: Path) -> None:
    main = """MODULE cell
  PROC main()
    Load "part.mod";
    %"work"% 2;
  ENDPROC
ENDMODULE
"""
    part = """MODULE part
  VAR num n:=5;
  PROC work(num by)
    n:=n/(by-by);
  ENDPROC
ENDMODULE
"""
    (tmp_path / "cell.home").mkdir()
    (tmp_path / "cell.home" / "part.mod").write_text(part)
    answers, _, _ = debug(tmp_path, ["3"], *("s", "s", "p n", "p by", "n", "w"), text=main)
    inside = "> cell.home/part.mod:4 in work\n-> n:=n/(by-by);"
    assert answers[2:6] == [inside, "5", "2", f"error: division by zero\n{inside}"]
    assert inside in answers[6]


@pytest.mark.process
def test_breakpoints_are_set_by_routine_and_by_line(tmp_path: Path) -> None:
    handler = LINE["d := sizes{2};"]
    answers, _, _ = debug(
        tmp_path,
        [f"cell.mod:{LINE['PROC main()']}"],
        *("b RISKY", "b nothing", f"b cell.mod:{handler - 1}", "b other.mod:1", "b 99"),
        *("c", "c", "w", "p d", "ll"),
    )
    first = LINE["d := 1 / d;"]
    assert f"cell.mod:{LINE['PROC main()']} holds no statement" in answers[0]
    assert at("CONNECT beat WITH at_beat;", "main") in answers[0]
    assert answers[1:6] == [
        f"Breakpoint 2 at cell.mod:{first}",
        "*** there is no routine `nothing`",
        f"Breakpoint 3 at cell.mod:{handler}",
        "*** 'other.mod' not found in the program",
        "*** there is no statement on this line or below",
    ]
    assert answers[6] == at("d := 1 / d;", "risky")
    assert answers[7] == at("d := sizes{2};", "the ERROR clause of risky")
    calls = ["risky;", "d := 1 / d;"]
    places = [(calls[0], "main"), (calls[1], "risky")]
    outer = "\n".join(f"  {at(*place)[2:]}" for place in places).strip()
    assert answers[8] == f"{outer}\n{answers[7]}"
    assert answers[9] == "0"
    assert "PROC risky()" in answers[10]
    assert answers[10].endswith("ENDPROC")


HIDING = """MODULE cell
  VAR num i := 5;
  PROC main()
    VAR num k := 9;
    FOR k FROM 1 TO 1 DO
      FOR k FROM 2 TO 2 DO
        ;
      ENDFOR
      ;
    ENDFOR
    FOR i FROM 3 TO 3 DO
      ;
    ENDFOR
    i := i + k;
  ENDPROC
ENDMODULE
"""


@pytest.mark.process
def test_a_counter_hides_what_has_its_name(tmp_path: Path) -> None:
    breaks = ["7", "9", "12", "14"]
    commands = ("p k", "c", "p k", "c", "p i", "c", "p i", "p k", "p tool0.mass", "c")
    answers, _, code = debug(tmp_path, breaks, *commands, text=HIDING)
    assert [answers[n] for n in (1, 3, 5, 7, 8)] == ["2", "1", "3", "5", "9"]
    assert answers[9] == "*** data of type tooldata have no component `mass`"
    assert code == 0


@pytest.mark.process
def test_it_goes_back_to_statements_and_breakpoints(tmp_path: Path) -> None:
    commands = ("back", "p own", "back", "", "c", "c", "p v", "rc", "p v", "cl", "c")
    answers, end, code = debug(tmp_path, [str(LINE["w := v;"])], *commands)
    copied, bump = at("w := v;", "bump"), 'bump Own, parts{2}.width \\label := "b";'
    assert answers[1:] == [
        at("v := v + 1;", "bump"),
        "*** `own` is not the name of data here",
        at(bump, "main"),
        at("ITimer 0.5, beat;", "main"),
        copied,
        copied,
        "4",
        copied,
        "1.1",
        "",
        end,
    ]
    # The result is that of a run without the prompt.
    assert ("", end.strip(), 0) == (answers[-2], debug(tmp_path, [])[1].strip(), code)


@pytest.mark.process
def test_conditions_and_values_are_rapid(tmp_path: Path) -> None:
    add = LINE["v := v + 1;"]
    answers, end, code = debug(
        tmp_path,
        [f"{add}, v = 3 AND NOT Present(label)"],
        *(
            "b",
            "count := 7",
            "p count * 2",
            "p sizes{3} + Abs(-1)",
            "b 900, v > 1",
            "b risky, nope",
        ),
        *("c", "cl 2", "until 0.55", "until 9", "c"),
    )
    assert answers[0].endswith(f"{at('v := v + 1;', 'bump')}\n")
    assert answers[1:] == [
        f"1: cell.mod:{add}, if v = 3 AND NOT Present(label)",
        "7",
        "14",
        "4",
        "*** there is no statement on this line or below",
        f"Breakpoint 2 at cell.mod:{LINE['d := 1 / d;']}",
        "the condition cannot be evaluated: `nope` is not the name of data here\n"
        + at("d := 1 / d;", "risky"),
        "",
        f"runs to 0.55 s\n{at('d := sizes{2};', 'the ERROR clause of risky')}",
        "*** no statement begins at 9 s or later",
        end,
    ]
    assert code == 0


@pytest.mark.process
def test_ctrl_c_stops_a_program_that_never_ends(tmp_path: Path) -> None:
    # A number that only grows stops changing at 2**24, and a loop in which nothing changes ends.
    text = (
        "MODULE m\nPROC main()\nVAR num n;\nWHILE TRUE DO\nIncr n;\nIF n>1000 n:=0;\nENDWHILE\n"
        "ENDPROC\nENDMODULE\n"
    )
    answers, _, code = debug(
        tmp_path, ["4"], "cl", "c", CTRL_C, "b 5", "rc", "p n < 1e6", text=text
    )
    assert "in main\n-> " in answers[2]
    assert answers[4:6] == ["> cell.mod:5 in main\n-> Incr n;", "TRUE"]
    assert code == 130


def test_ctrl_c_between_a_command_and_the_program_stops_the_program() -> None:
    pauses: list[None] = []
    session: Any = SimpleNamespace(
        search=None,
        is_running=False,
        debugger=SimpleNamespace(pause=lambda: pauses.append(None)),
    )
    prompt = debugger._Prompt(ProgramFiles(()))
    prompt.session = session
    with pytest.raises(KeyboardInterrupt):
        prompt.interrupted(2, None)
    prompt._request = {"command": "continue"}
    prompt.interrupted(2, None)
    assert len(pauses) == 1


@pytest.mark.process
def test_a_run_on_the_network_does_not_go_back(tmp_path: Path) -> None:
    place = [str(LINE["risky;"]), "--allow-network"]
    answers, _, code = debug(tmp_path, place, "back", "until 9", "n")
    refusal = "*** not on Windows, and not in a run with --allow-network"
    assert answers[1:] == [refusal, refusal, at('%"risky"%;', "main")]
    assert code == 130


@pytest.mark.process
def test_the_exit_code_is_that_of_the_run(tmp_path: Path) -> None:
    text = CELL.replace("    d := sizes{2};\n    TRYNEXT;\n", "    RAISE;\n")
    answers, end, code = debug(tmp_path, [str(LINE["risky;"])], "n", "back", "c", text=text)
    assert answers[1].startswith("error: division by zero\n> cell.mod:")
    assert answers[2] == at("risky;", "main")
    assert "stopped with an error" in end
    assert code == 1


TASKS = """[[task]]
modules = ["cell.mod"]

[[task]]
name = "T_BACK"
type = "semistatic"
modules = ["two.mod"]
"""
BACKGROUND = """MODULE two
  PERS num count := 3;
  PROC main()
    WaitTime 0.2;
    count := count + 1;
    WaitTime 0.2;
  ENDPROC
ENDMODULE
"""


@pytest.mark.process
def test_all_tasks_of_a_cell_stop_and_step(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(TASKS)
    (tmp_path / "two.mod").write_text(BACKGROUND)
    commands = ("t", "p count", "t T_ROB1", "t nope", "n", "p count", "back", "p count", "s")
    answers, _, code = debug(tmp_path, ["two.mod:5"], *commands)
    counting = "> two.mod:5 in main of T_BACK\n-> count := count + 1;"
    assert answers[0].endswith(f"{counting}\n")
    waiting = f"> cell.mod:{LINE['WaitTime 0.6;']} in main of T_ROB1\n-> WaitTime 0.6;"
    assert answers[1:] == [
        "T_ROB1\n> T_BACK",
        "4",
        waiting,
        "*** there is no task `nope`",
        f"> cell.mod:{LINE['risky;']} in main of T_ROB1\n-> risky;",
        "6",
        counting,
        "4",
        counting.replace(":5", ":6").replace("count := count + 1", "WaitTime 0.2"),
    ]
    assert code == 130


def test_without_a_terminal_it_is_refused(tmp_path: Path) -> None:
    (tmp_path / "cell.mod").write_text(CELL)
    ended = rapidsim("run", "cell.mod", "--no-record", "--break", "cell.mod:12", cwd=tmp_path)
    assert ended.code == 2
    assert "--break needs a terminal" in ended.err


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ("cell.mod", "--break cell.mod: expected FILE:LINE"),
        ("cel.mod:3", "--break: cel.mod is not in the program"),
        ("cell.mod:990", "--break: cell.mod has no statement on line 990 or below"),
    ],
)
def test_a_place_that_is_none_is_refused(place: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "cell.mod").write_text(CELL)
    arguments = ("run", "cell.mod", "--no-record", "--break", place)
    ended = rapidsim(*arguments, cwd=tmp_path, terminal=True)
    assert ended.code == 2
    assert message in ended.err
