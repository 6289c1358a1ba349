"""Checks in several processes: what they say is what one says, however they end."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from check_helper import HERE
from command_line import call

from rapidsim.cli import boundary
from rapidsim.cli.commands import check as check_command
from rapidsim.files import InputError
from rapidsim.jobs.cache.processes import DefectError, in_processes

PROGRAMS = Path(__file__).parents[2] / "programs"
SEVERAL = ("out_of_reach.mod", "circle.mod")


def told(*arguments: object, cwd: Path) -> tuple[int, str, str]:
    ended = call("check", *arguments, cwd=cwd)
    return ended.code, re.sub(r" \([0-9.]+ s\)", "", ended.out), ended.err


@pytest.mark.parametrize("form", ["full", "junit"])
def test_programs_side_by_side_say_the_same(form: str, tmp_path: Path) -> None:
    programs = [PROGRAMS / name for name in SEVERAL]
    programs += [HERE / "planted" / "welding_cell.mod"]
    arguments = ("--each", *programs, "--output-format", form)
    one = told(*arguments, cwd=tmp_path)
    assert told(*arguments, "-j", 2, cwd=tmp_path) == one
    assert one[0] == 1


def test_tasks_side_by_side_say_the_same(tmp_path: Path) -> None:
    arguments = (PROGRAMS / "shared_machine", "--output-format", "full")
    assert told(*arguments, "-j", 2, cwd=tmp_path) == told(*arguments, cwd=tmp_path)


def test_what_is_special_about_an_arm_is_said_once(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / f"{name}.mod").write_text(
            f"MODULE {name}\n  PROC main()\n"
            "    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
            "  ENDPROC\nENDMODULE\n"
        )
    arguments = ("--each", "one.mod", "two.mod", "--robot", "crb15000-5-0.95")
    one = told(*arguments, cwd=tmp_path)
    assert told(*arguments, "-j", 2, cwd=tmp_path) == one
    assert one[2].count("note: ") == len(set(one[2].splitlines()))
    assert "note: " in one[2]


ALWAYS = """MODULE one
  PROC main()
    IF TRUE THEN
      WaitTime 1;
    ENDIF
  ENDPROC
ENDMODULE
"""


def test_each_program_has_its_own_names_settings_and_baseline(tmp_path: Path) -> None:
    left, right = tmp_path / "left", tmp_path / "right"
    for folder in (left, right):
        folder.mkdir()
        (folder / "one.mod").write_text(ALWAYS)
    together = told("left", "right", cwd=tmp_path)
    assert "N202" in together[1]
    each = ("--each", "left", "right", "--output-format", "concise")
    files = [Path(name, "one.mod") for name in ("left", "right")]
    expected = [f"{file}:3:8: warning[F402] this condition is always TRUE" for file in files]
    assert told(*each, cwd=tmp_path)[1].splitlines()[:-1] == expected
    assert told(*each, "--baseline", "known.json", cwd=tmp_path)[0] == 0
    assert told(*each, "--baseline", "known.json", cwd=tmp_path)[0] == 0
    told("left", "--baseline", "left/known.json", cwd=tmp_path)
    (left / "rapidsim.toml").write_text('[check]\nbaseline = "known.json"\n')
    assert told(*each, cwd=tmp_path)[1].startswith(str(Path("right", "one.mod")))
    assert told(*each, cwd=tmp_path)[0] == 1
    (right / "rapidsim.toml").write_text('[check]\nfail-on = "error"\n')
    assert told(*each, cwd=tmp_path)[0] == 0
    assert told(*each, "--fail-on", "warning", cwd=tmp_path)[0] == 1


def test_fixes_go_into_each_program(tmp_path: Path) -> None:
    for name in ("a.mod", "b.mod"):
        (tmp_path / name).write_text(
            "MODULE one\n  PROC main()\n    WaitTime 1\n  ENDPROC\nENDMODULE\n"
        )
    shown = told("--each", "a.mod", "b.mod", "--diff", cwd=tmp_path)
    assert shown[1].count("+    WaitTime 1;") == 2
    fixed = told("--each", "a.mod", "b.mod", "--fix", cwd=tmp_path)
    assert "Fixed 2." in fixed[1]
    assert "WaitTime 1;" in (tmp_path / "b.mod").read_text()


def test_the_number_of_processes() -> None:
    [option] = [one for one in check_command.check.params if one.name == "processes"]
    cores = option.type.convert("auto", None, None)
    assert cores == option.type.convert("0", None, None) >= 1
    assert option.type.convert("3", None, None) == 3


# What the processes below do; they find it by name.
def _answer(number: int) -> int:
    if number == 3:
        raise InputError("three is wrong", "take four")
    if number == 5:
        return 1 // (number - 5)
    if number == 7:
        os._exit(9)
    return -number


def test_results_come_in_the_order_of_the_things() -> None:
    assert [*in_processes(_answer, [1, 2, 4, 6], 2, at_once=2)] == [-1, -2, -4, -6]
    assert [*in_processes(_answer, [1, 2], 1)] == [-1, -2]


def test_a_mistake_is_told_as_in_one_process() -> None:
    made = in_processes(_answer, [1, 3, 5], 2)
    assert next(made) == -1
    with pytest.raises(InputError) as told:
        next(made)
    assert (told.value.message, told.value.help) == ("three is wrong", "take four")


def test_a_defect_is_told_as_one() -> None:
    with pytest.raises(DefectError) as told:
        [*in_processes(_answer, [1, 5], 2)]
    line = boundary._defect_line(told.value)
    assert "has a defect (ZeroDivisionError: integer division or modulo by zero" in line
    assert re.search(r"at test_check_processes\.py:\d+\)", line)
    assert "_answer" in told.value.report


def test_a_process_that_dies_is_told() -> None:
    with pytest.raises(DefectError, match="ended without an answer"):
        [*in_processes(_answer, [1, 7], 2)]


# Two processes are waited for, and then everybody hears Ctrl-C as in a terminal.
INTERRUPTED = """
import os, signal, threading, time
from multiprocessing import active_children
signal.signal(signal.SIGINT, signal.default_int_handler)
def later():
    while len(active_children()) < 2:
        time.sleep(0.001)
    os.killpg(os.getpgrp(), getattr(signal, os.environ["HEARD"]))
if __name__ == "__main__":
    from rapidsim.cli import main
    threading.Thread(target=later, daemon=True).start()
    main()
"""


@pytest.mark.process
@pytest.mark.skipif(os.name != "posix", reason="no groups of processes there")
def test_ctrl_c_ends_all_processes(tmp_path: Path) -> None:
    endless = "MODULE m\n  PROC main()\n    WHILE TRUE DO\n    ENDWHILE\n  ENDPROC\nENDMODULE\n"
    for name in ("a.mod", "b.mod", "c.mod"):
        (tmp_path / name).write_text(endless)
    (tmp_path / "interrupted.py").write_text(INTERRUPTED)
    started = subprocess.Popen(
        [sys.executable, "interrupted.py", "check", "--each", "a.mod", "b.mod", "c.mod", "-j", "2"],
        cwd=tmp_path,
        env={**os.environ, "HEARD": "SIGINT"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        text=True,
    )
    # Which waits for all that hold these streams, and they would work for long.
    out, err = started.communicate()
    assert (started.returncode, out, err) == (130, "", "interrupted after 0 of 3 programs\n")


def test_a_program_that_cannot_be_read_does_not_stop_the_others(tmp_path: Path) -> None:
    (tmp_path / "one.mod").write_text(ALWAYS)
    (tmp_path / "encoded.sys").write_bytes(bytes(range(256)) * 20)
    code, out, *_ = told("--each", "encoded.sys", "one.mod", "--format", "json", cwd=tmp_path)
    report = json.loads(out)
    assert code == 2
    assert [one["code"] for one in report["diagnostics"]] == ["F402"]
    assert "encoded.sys is encoded" in report["error"]["message"]
    alone = told("--each", "encoded.sys", cwd=tmp_path)
    assert alone[0] == 2
