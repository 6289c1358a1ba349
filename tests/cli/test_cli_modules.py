"""Several modules as one task: whose names are meant, one clear message where that is unclear."""

import json
from pathlib import Path

import pytest
from cli_helper import rapidsim

EMPTY_MAIN = "MODULE Shop\n  PROC main()\n  ENDPROC\nENDMODULE\n"


def folder(path: Path, **modules: str) -> Path:
    for name, text in modules.items():
        (path / f"{name}.mod").write_text(text)
    return path


def texts(path: Path) -> list[str]:
    """What the program of a folder shows; it must end without any finding."""
    ended = rapidsim("run", path, "--no-record", "--format", "json", cwd=path.parent)
    report = json.loads(ended.out)
    assert (ended.code, report["end"], report["diagnostics"]) == (0, "ended", [])
    return [event["message"] for event in report["events"] if event["kind"] == "text"]


def finding(path: Path) -> tuple[str, int, str]:
    """File, line and code of the only finding but for unused data: run and check agree."""
    options = ("--ignore", "N204", "--output-format", "json")
    checked = rapidsim("check", path, *options, cwd=path.parent)
    ran = rapidsim("run", path, "--no-record", "--format", "json", cwd=path.parent)
    assert (checked.code, ran.code) == (1, 1)
    (one,) = json.loads(checked.out)["diagnostics"]
    (same,) = json.loads(ran.out)["diagnostics"]
    assert same == one
    return Path(one["file"]).name, one["line"], one["code"]


def test_modules_call_each_other_and_share_global_data(tmp_path: Path) -> None:
    main = (
        "MODULE Shop\n  PROC main()\n    count;\n    count;\n"
        "    TPWrite ValToStr(counted)+limit;\n  ENDPROC\nENDMODULE\n"
    )
    counting = (
        "MODULE Counting\n  PERS num counted:=0;\n  LOCAL CONST num width:=2;\n"
        '  CONST string limit:=" of 9";\n'
        "  PROC count()\n    counted:=counted+width;\n  ENDPROC\nENDMODULE\n"
    )
    assert texts(folder(tmp_path, Main=main, Counting=counting)) == ["4 of 9"]


def test_local_data_and_routines_hide_global_ones_in_their_module_only(tmp_path: Path) -> None:
    main = (
        'MODULE Shop\n  VAR string who:="global";\n  PROC main()\n    say;\n    other;\n  ENDPROC\n'
        "  PROC say()\n    TPWrite who;\n  ENDPROC\nENDMODULE\n"
    )
    other = (
        'MODULE Others\n  LOCAL VAR string who:="local";\n'
        '  PROC other()\n    VAR num k;\n    say;\n    routine;\n    %"say"%;\n  ENDPROC\n'
        '  LOCAL PROC say()\n    TPWrite "local say, "+who;\n  ENDPROC\n'
        '  PROC routine()\n    VAR string who:="routine";\n    TPWrite who;\n  ENDPROC\nENDMODULE\n'
    )
    shown = texts(folder(tmp_path, Main=main, Other=other))
    assert shown == ["global", "local say, local", "routine", "local say, local"]


def test_a_local_main_is_not_where_the_program_starts(tmp_path: Path) -> None:
    other = 'MODULE Others\n  LOCAL PROC main()\n    TPWrite "no";\n  ENDPROC\nENDMODULE\n'
    main = EMPTY_MAIN.replace("main()\n", 'main()\n    TPWrite "yes";\n')
    assert texts(folder(tmp_path, Main=main, Another=other)) == ["yes"]


@pytest.mark.parametrize(
    ("other", "place"),
    [
        ("MODULE SHOP\n  PROC work()\n  ENDPROC\nENDMODULE\n", ("B.mod", 1, "N202")),
        ("MODULE Others\n  PROC main()\n  ENDPROC\nENDMODULE\n", ("B.mod", 2, "N202")),
        ("MODULE Others\n  PROC work()\n  ENDPROC\n", ("B.mod", 3, "E102")),
        ("MODULE Others\n  VAR num main;\nENDMODULE\n", ("B.mod", 2, "N202")),
        ("MODULE Others\n  LOCAL VAR num a;\n  VAR num A;\nENDMODULE\n", ("B.mod", 3, "N202")),
    ],
    ids=["module twice", "main twice", "no ENDMODULE", "main as data", "twice in a module"],
)
def test_what_is_not_clear_is_one_finding(
    other: str, place: tuple[str, int, str], tmp_path: Path
) -> None:
    assert finding(folder(tmp_path, A=EMPTY_MAIN, B=other)) == place


def test_a_global_in_two_modules_names_both(tmp_path: Path) -> None:
    first = "MODULE A\n  VAR num n;\n  PROC main()\n    n:=1;\n  ENDPROC\nENDMODULE\n"
    folder(tmp_path, A=first, B="MODULE B\n  PERS num N:=2;\nENDMODULE\n")
    assert finding(tmp_path) == ("B.mod", 2, "N202")
    ended = rapidsim("run", tmp_path, "--no-record", cwd=tmp_path)
    assert "is declared twice, in `A` and in `B`" in ended.out
    assert "the first one is here" in ended.out


def test_without_main_the_procedures_that_are_there_are_named(tmp_path: Path) -> None:
    folder(tmp_path, A="MODULE A\n  PROC pick()\n  ENDPROC\n  PROC place()\n  ENDPROC\nENDMODULE\n")
    ended = rapidsim("run", tmp_path, "--no-record", cwd=tmp_path)
    assert (ended.code, ended.out) == (2, "")
    assert "the program has no procedure `main`" in ended.err
    assert "--proc names one: `pick`, `place`" in ended.err
    assert rapidsim("run", tmp_path, "--proc", "place", "--no-record", cwd=tmp_path).code == 0


def test_of_several_tasks_the_one_without_a_main_is_named(tmp_path: Path) -> None:
    for name, procedure in (("robot", "main"), ("plc", "other")):
        text = f"MODULE {name}\n  PROC {procedure}()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n"
        (tmp_path / f"{name}.mod").write_text(text)
    (tmp_path / "rapidsim.toml").write_text(
        '[[task]]\nname = "T_ROB1"\nmodules = ["robot.mod"]\n'
        '[[task]]\nname = "T_PLC"\nmodules = ["plc.mod"]\n'
    )
    ended = rapidsim("run", tmp_path, "--no-record", cwd=tmp_path)
    assert ended.code == 2
    assert "the task T_PLC has no procedure `main`" in ended.err


def test_a_main_with_parameters_cannot_be_started(tmp_path: Path) -> None:
    folder(tmp_path, A="MODULE A\n  PROC main(num n)\n  ENDPROC\nENDMODULE\n")
    ended = rapidsim("run", tmp_path, "--no-record", cwd=tmp_path)
    assert ended.code == 2
    assert "`main` is not a procedure that runs without arguments" in ended.err
