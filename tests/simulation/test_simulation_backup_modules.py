"""Modules of the tasks of a controller backup, and what is said of those nobody can read."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rapidsim.files import InputError
from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.running.run_files import simulate

Backup = Callable[[dict[str, str | bytes]], Path]

MAIN = """MODULE MainModule
  PROC main()
    TPWrite "main";
    fromUser;
  ENDPROC
ENDMODULE
"""
USER = """MODULE user(SYSMODULE)
  PROC fromUser()
    TPWrite "user";
  ENDPROC
ENDMODULE
"""
SYS = r"""SYS:CFG_1.0:6:1::
#
CAB_TASK_MODULES:

      -File "HOME:/user.sys" -ModName "user" -AllTask
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "logger" -Entry "log_main"
"""
LOGGER = """MODULE logs
  PROC log_main()
    TPWrite "log";
    fromUser;
    WaitTime 100;
  ENDPROC
ENDMODULE
"""
CODE = bytes(range(1, 256)) * 8


@pytest.fixture
def backup(tmp_path: Path) -> Backup:
    def written(files: dict[str, str | bytes]) -> Path:
        for name, content in files.items():
            file = tmp_path / "cell" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content.encode() if isinstance(content, str) else content)
        return tmp_path / "cell"

    return written


def listed(*modules: str) -> str:
    return "\n".join([">>TASK1: (T_ROB1,,)", *(f"{one} @ " for one in modules), ">>EOF:"])


def texts(folder: Path) -> set[str]:
    return {one.message for one in simulate([folder]).events if one.kind.value == "text"}


def codes(folder: Path) -> list[tuple[str, str]]:
    return [(one.violation.code, one.severity.value) for one in check([folder]).diagnostics]


def test_a_file_that_the_backup_does_not_list_is_not_loaded(backup: Backup) -> None:
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("SYSMOD\\user.sys", "PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN,
            "RAPID/TASK1/PROGMOD/Older.mod": MAIN,
            "RAPID/TASK1/SYSMOD/user.sys": USER,
        }
    )
    assert codes(folder) == []
    assert texts(folder) == {"main", "user"}


@pytest.mark.parametrize("content", [CODE, None])
def test_what_a_module_that_cannot_be_read_may_declare_is_no_error(
    backup: Backup, content: bytes | None
) -> None:
    files: dict[str, str | bytes] = {
        "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod", "PROGMOD/Secret.mod"),
        "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN.replace("fromUser", "reg1:=secret"),
    }
    if content is not None:
        files["RAPID/TASK1/PROGMOD/Secret.mod"] = content
    folder = backup(files)
    assert codes(folder) == [("N216", "warning")]
    (folder / "RAPID/TASK1/PROGMOD/Secret.mod").write_text("MODULE Secret\nENDMODULE\n")
    assert codes(folder) == [("N201", "error")]


def test_a_backup_without_backinfo_has_the_folders_of_its_tasks(backup: Backup) -> None:
    folder = backup(
        {
            "RAPID/T_ROB1/PROGMOD/MainModule.mod": MAIN,
            "RAPID/logger/logs.mod": LOGGER,
            "HOME/user.sys": USER,
            "SYSPAR/SYS.cfg": SYS,
        }
    )
    assert codes(folder) == []
    run = simulate([folder])
    said = {(one.task, one.message) for one in run.events if one.kind.value == "text"}
    assert said == {
        ("T_ROB1", "main"),
        ("T_ROB1", "user"),
        ("logger", "log"),
        ("logger", "user"),
    }


def test_all_modules_may_come_from_home(backup: Backup) -> None:
    loads = [
        f'-File "HOME:/{name}" -Task "{task}"'
        for name, task in (("MainModule.mod", "T_ROB1"), ("logs.mod", "logger"))
    ]
    files: dict[str, str | bytes] = {
        "HOME/MainModule.mod": MAIN.replace("fromUser;", "fromUser;\n    WaitTime 1;"),
        "HOME/logs.mod": LOGGER,
        "HOME/user.sys": USER,
        "SYSPAR/SYS.cfg": SYS.replace("#\nCAB_TASKS", "\n\n".join([*loads, "#\nCAB_TASKS"])),
    }
    folder = backup(files)
    assert codes(folder) == []
    assert texts(folder) == {"main", "log", "user"}
    (folder / "SYSPAR/SYS.cfg").write_text(SYS.replace("-AllTask", '-Task "T_ROB1"'))
    with pytest.raises(InputError, match=r"loads no module into logger$"):
        check([folder])


def test_the_task_of_the_safety_controller_is_not_run(backup: Backup) -> None:
    folder = backup(
        {
            "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\n\n>>TASK2: (SC_CBC,,)\n",
            "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN,
            "RAPID/TASK1/SYSMOD/user.sys": USER,
            "RAPID/TASK2/SYSMOD/user.sys": USER,
            "SYSPAR/SYS.cfg": SYS,
        }
    )
    assert texts(folder) == {"main", "user"}


def test_a_module_of_an_add_in_may_declare_what_the_backup_does_not(backup: Backup) -> None:
    add_in = '-File "ADDIN:/RAPID/Tools.mod" -ModName "Tools" -AllMotionTask\n#\nCAB_TASKS:'
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN.replace("fromUser", "reg1:=toolCount"),
            "HOME/user.sys": USER,
            "SYSPAR/SYS.cfg": SYS.replace("#\nCAB_TASKS:", f"\n      {add_in}"),
        }
    )
    assert codes(folder) == [("N216", "warning")]


def test_what_an_option_without_a_library_may_declare_is_no_error(backup: Backup) -> None:
    task = listed("PROGMOD/MainModule.mod")
    files: dict[str, str | bytes] = {
        "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN.replace("fromUser", "reg1:=PM_OF_OPTION"),
    }
    for product, code in (("616-1 PC Interface", "N201"), ("642-2 Palletizing PowerPac", "N216")):
        products = f">>PRODUCTS_ID:\nRobotWare Version: 6.08.01.00\n  {product}\n"
        folder = backup({"BACKINFO/backinfo.txt": products + task, **files})
        assert [found for found, _ in codes(folder)] == [code], product


LATE = r"""CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -BindRef {} -MotionTask
"""


@pytest.mark.parametrize(("check_references", "severity"), [("0", "warning"), ("1", "error")])
def test_data_that_nothing_declares_are_a_warning_where_references_are_not_checked(
    backup: Backup, check_references: str, severity: str
) -> None:
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN.replace("fromUser", "reg1:=nowhere"),
            "SYSPAR/SYS.cfg": LATE.format(check_references),
        }
    )
    assert {one for _, one in codes(folder)} == {severity}


MISSING = (
    "reg1:=missing;",
    "missing:=1;",
    "missing{2}.trans.x:=reg1;",
    'TPWrite "never"\\Num:=missing;',
    "MoveAbsJ missing\\NoEOffs,v100,fine,tool0;",
    "IF missing THEN\n reg1:=2;\n ENDIF",
    "IF reg1=5 THEN\n reg1:=2;\n ELSEIF missing{2}.x>3 THEN\n reg1:=2;\n ENDIF",
    "IF missing=1 reg1:=2;",
    "WHILE missing<3 DO\n reg1:=2;\n ENDWHILE",
    "FOR i FROM 1 TO missing DO\n reg1:=2;\n ENDFOR",
    "TEST missing\n CASE 1: reg1:=2;\n ENDTEST",
    "TEST reg1\n CASE missing: reg1:=2;\n ENDTEST",
    "CONNECT missing WITH noted;",
    "RETURN;\n reg1:=missing;",
)


@pytest.mark.parametrize("statement", MISSING)
def test_a_run_goes_on_to_data_that_nothing_declares(backup: Backup, statement: str) -> None:
    caught = (
        f'PROC main()\n try;\n TPWrite "done";\nENDPROC\nTRAP noted\nENDTRAP\n'
        f'PROC try()\n TPWrite "first";\n {statement}\n'
        'ERROR\n IF ERRNO=ERR_REFUNKDAT TPWrite "caught";\n TRYNEXT;\nENDPROC\n'
    )
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": f"MODULE MainModule\n{caught}ENDMODULE\n",
            "SYSPAR/SYS.cfg": LATE.format("0"),
        }
    )
    assert "N221" in {code for code, severity in codes(folder) if severity == "warning"}
    assert "R101" not in {code for code, _ in codes(folder)}
    run = simulate([folder])
    said = [one.message for one in run.events if one.kind.value == "text"]
    met = [] if statement.startswith("RETURN") else ["caught"]
    assert said == ["first", *met, "done"]
    assert run.end == "ended"


def test_an_error_at_data_that_nothing_declares_says_so(backup: Backup) -> None:
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": MAIN.replace("fromUser", "reg1:=nowhere"),
            "SYSPAR/SYS.cfg": LATE.format("0"),
        }
    )
    run = simulate([folder])
    told = [one for one in run.diagnostics if one.severity.value == "error"]
    assert [one.message for one in told] == ["no data are named `nowhere` (ERR_REFUNKDAT)"]
    assert run.end == "error"


def test_a_routine_that_nothing_declares_is_an_error_of_the_run_there(backup: Backup) -> None:
    caught = (
        'PROC main()\n TPWrite "first";\n IF nowhere(1)=2 TPWrite "never";\n TPWrite "never";\n'
        "ERROR\n IF ERRNO=ERR_REFUNKFUN THEN\n gone 1,unknown;\n ENDIF\n"
        ' TPWrite "never";\n TRYNEXT;\nENDPROC\n'
    )
    folder = backup(
        {
            "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod"),
            "RAPID/TASK1/PROGMOD/MainModule.mod": f"MODULE MainModule\n{caught}ENDMODULE\n",
            "SYSPAR/SYS.cfg": LATE.format("0"),
        }
    )
    # The run of a check comes there, too; another task may load what is missing.
    assert {"N209": "warning", "R101": "warning"}.items() == set(codes(folder)[:3])
    run = simulate([folder])
    assert [one.message for one in run.events if one.kind.value == "text"] == ["first"]
    assert run.end == "error"
    assert [one.message for one in run.diagnostics if one.violation.code == "R101"] == [
        "no procedure is named `gone` (ERR_REFUNKPRC)"
    ]


@pytest.mark.parametrize(
    ("statement", "code", "what"),
    [
        ("reg1:=secret", "N216", "`secret` is declared in no module that can be read"),
        ("secret:=1", "N216", "`secret` is declared in no module that can be read"),
        ("glue.flow:=1", "N215", "`glue` is gluedata, whose declaration is missing"),
        ("IF glue.flow=1 Stop", "N215", "`glue` is gluedata, whose declaration is missing"),
    ],
)
def test_a_run_goes_on_to_what_a_module_declares_that_cannot_be_read(
    backup: Backup, statement: str, code: str, what: str
) -> None:
    main = MAIN.replace("fromUser", f"RETURN;\n  ENDPROC\n  PROC other()\n    {statement}")
    main = main.replace("PROC main", "PERS gluedata glue;\n  PROC main")
    files: dict[str, str | bytes] = {
        "BACKINFO/backinfo.txt": listed("PROGMOD/MainModule.mod", "PROGMOD/Secret.mod"),
        "RAPID/TASK1/PROGMOD/MainModule.mod": main,
        "RAPID/TASK1/PROGMOD/Secret.mod": CODE,
    }
    folder = backup(files)
    assert (code, "warning") in codes(folder)
    assert "R140" not in {found for found, _ in codes(folder)}
    assert simulate([folder]).end == "ended"
    files["RAPID/TASK1/PROGMOD/MainModule.mod"] = main.replace("RETURN", "other")
    run = simulate([backup(files)])
    told = [one for one in run.diagnostics if one.violation.code == "R140"]
    assert [one.message for one in told] == [f"{what}: a run cannot continue from here"]
    assert texts(folder) == {"main"}
    assert run.end == "error"
