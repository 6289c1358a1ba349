"""Every mistake a user can make with the command line: one clear message, the right exit code."""

from pathlib import Path

import pytest
from cli_helper import Ended, rapidsim

MODULE = "MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n"


def refused(ended: Ended, *parts: str) -> None:
    assert ended.code == 2
    assert ended.out == ""
    assert ended.err.startswith("error: ")
    assert len(ended.err.splitlines()) <= 2
    for part in parts:
        assert part in ended.err


@pytest.mark.parametrize("command", ["run", "check", "frames"])
def test_a_missing_file_is_named(command: str, tmp_path: Path) -> None:
    (tmp_path / "weld.mod").write_text(MODULE)
    ended = rapidsim(command, "wedl.mod", cwd=tmp_path)
    refused(ended, "wedl.mod does not exist", "did you mean `weld.mod`?")


@pytest.mark.parametrize("command", ["run", "check", "frames"])
def test_text_that_is_no_rapid_is_refused(command: str, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("Remember to grease joint 4.\n")
    refused(rapidsim(command, "notes.txt", cwd=tmp_path), "notes.txt is not a RAPID file", ".mod")


def test_a_module_under_another_name_is_taken(tmp_path: Path) -> None:
    (tmp_path / "000BCDE9").write_text(MODULE)
    assert rapidsim("check", "000BCDE9", cwd=tmp_path).code == 0


@pytest.mark.parametrize("command", ["run", "check"])
def test_an_empty_folder_is_never_fine(command: str, tmp_path: Path) -> None:
    (tmp_path / "cell").mkdir()
    refused(rapidsim(command, "cell", cwd=tmp_path), "cell holds no RAPID file")


def test_a_folder_of_folders_says_where_modules_are(tmp_path: Path) -> None:
    (tmp_path / "cell" / "station1").mkdir(parents=True)
    (tmp_path / "cell" / "station1" / "a.mod").write_text(MODULE)
    refused(rapidsim("check", "cell", cwd=tmp_path), "station1")


def test_folders_far_below_are_named_too(tmp_path: Path) -> None:
    backup = tmp_path / "work" / "line 2" / "backup"
    (backup / "RAPID" / "TASK1" / "PROGMOD").mkdir(parents=True)
    (tmp_path / "work" / "old" / "first").mkdir(parents=True)
    (tmp_path / "work" / "old" / "first" / "a.mod").write_text(MODULE)
    ended = rapidsim("check", "work", cwd=tmp_path)
    refused(ended, "line 2/backup, old/first: name one of these folders")


def test_no_path_is_a_usage_mistake() -> None:
    refused(rapidsim("check"), "PATH... is missing", "`rapidsim check .` takes this folder")


def test_an_unknown_robot_brings_near_names(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(MODULE)
    for arguments in (
        ("run", "a.mod", "--robot", "irb12"),
        ("check", "a.mod", "--robot", "irb12"),
        ("robots", "irb12"),
    ):
        refused(rapidsim(*arguments, cwd=tmp_path), "`irb12`", "irb120")


@pytest.mark.parametrize(
    ("wrong", "right"),
    [("--recrod", "--record"), ("--fromat", "--format"), ("--max_time", "--max-time")],
)
def test_a_misspelt_option_brings_the_right_one(wrong: str, right: str) -> None:
    refused(rapidsim("run", "a.mod", wrong, "x"), f"`{wrong}`", f"did you mean `{right}`")


def test_a_misspelt_command_brings_the_right_one() -> None:
    refused(rapidsim("chekc", "a.mod"), "`chekc`", "did you mean `check`?")


@pytest.mark.parametrize(
    "arguments", [("explain",), ("check", "a.mod", "--select"), ("check", "a.mod", "--ignore")]
)
def test_an_unknown_rule_brings_near_ones(arguments: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(MODULE)
    refused(rapidsim(*arguments, "R1001", cwd=tmp_path), "`R1001`", "R101")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (("--format", "xml"), "'xml' is not one of"),
        (("--max-time", "-3"), "--max-time"),
        (("--cycles", "0"), "--cycles"),
        (("--dt", "0"), "--dt"),
        (("--trace", "trace.txt"), "trace.txt must end in .csv or .parquet or .json"),
        (("--trace", "nowhere/trace.csv"), "nowhere is not a folder"),
        (("--record", "out.mp4"), "out.mp4 must end in .rrd"),
        (("--record", "out.rrd", "--no-record"), "exclude each other"),
        (("--home", "nowhere"), "nowhere is not a folder"),
        (("--answers", "nowhere.txt"), "nowhere.txt does not exist"),
        (("--station", "nowhere.toml"), "nowhere.toml does not exist"),
        (("--proc", "mian"), "did you mean `main`?"),
    ],
)
def test_a_wrong_value_is_named(arguments: tuple[str, ...], part: str, tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text(MODULE)
    refused(rapidsim("run", "a.mod", *arguments, cwd=tmp_path), part)
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.mod"]


def test_the_bare_name_shows_the_commands() -> None:
    ended = rapidsim()
    assert ended.code == 2
    assert "check" in ended.out
    assert ended.err == ""


@pytest.mark.parametrize("arguments", [("-h",), ("--help",), ("run", "-h"), ("check", "--help")])
def test_help_is_clean(arguments: tuple[str, ...]) -> None:
    ended = rapidsim(*arguments)
    assert (ended.code, ended.err) == (0, "")
    assert "Usage: rapidsim" in ended.out


@pytest.mark.parametrize("arguments", [("--version",), ("run", "--version")])
def test_version_stands_everywhere(arguments: tuple[str, ...]) -> None:
    ended = rapidsim(*arguments)
    assert ended.code == 0
    assert ended.out.startswith("rapidsim 0.")


@pytest.mark.parametrize("date", ["yesterday", "2025-13-01", "2025-03-01T06:00:00Z"])
def test_a_date_is_asked_for_by_example(date: str) -> None:
    refused(rapidsim("run", "a.mod", "--start-time", date), f"`{date}`", "2025-03-01T06:00:00")


def test_a_robot_that_is_like_none_does_not_bring_the_whole_catalogue(tmp_path: Path) -> None:
    ended = rapidsim("robots", "qqq")
    refused(ended, "`qqq` is not in the catalogue", "`rapidsim robots` lists the catalogue")
    assert "irb" not in ended.err


def test_what_starts_a_program_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text("MODULE a\nPROC other()\nENDPROC\nENDMODULE\n")
    refused(rapidsim("run", "a.mod", cwd=tmp_path), "--proc names one: `other`")
