"""Text that people read, compared with golden files in two widths."""

import pytest
from cli_helper import PROGRAMS, assert_golden, rapidsim

COLUMNS = (80, 120)


@pytest.mark.parametrize("columns", COLUMNS)
def test_the_robots(columns: int) -> None:
    one = rapidsim("robots", "irb120", columns=columns)
    assert one.code == 0
    shown = "".join(line for line in one.out.splitlines(True) if not line.startswith("shapes"))
    assert_golden(f"robot_{columns}.txt", shown)
    every = rapidsim("robots", columns=columns)
    assert max(map(len, every.out.splitlines())) <= columns
    assert "irb1600-6-1.2" in every.out


@pytest.mark.parametrize("columns", COLUMNS)
def test_the_frames(columns: int) -> None:
    ended = rapidsim("frames", "cell.mod", columns=columns)
    assert (ended.code, ended.err) == (0, "")
    assert_golden(f"frames_{columns}.txt", ended.out)


@pytest.mark.parametrize("columns", COLUMNS)
def test_findings_in_full(columns: int) -> None:
    ended = rapidsim("check", "wrong.mod", columns=columns)
    assert (ended.code, ended.err) == (1, "")
    assert_golden(f"check_full_{columns}.txt", ended.out)


def test_findings_on_a_line_each() -> None:
    ended = rapidsim("check", "wrong.mod", "--output-format", "concise")
    assert (ended.code, ended.err) == (1, "")
    assert_golden("check_concise.txt", ended.out)


def test_a_page() -> None:
    ended = rapidsim("explain", "question-unanswered")
    assert (ended.code, ended.err) == (0, "")
    assert_golden("explain.txt", ended.out)


@pytest.mark.parametrize("command", ["", "run", "check", "explain", "robots", "frames"])
def test_help(command: str) -> None:
    ended = rapidsim(*command.split(), "--help")
    assert ended.code == 0
    assert max(map(len, ended.out.splitlines())) <= 80


def test_a_clean_program_says_so_and_what_was_not_looked_at() -> None:
    ended = rapidsim("check", "cell.mod", "--ignore", "unused-data")
    assert (ended.code, ended.err) == (0, "")
    assert_golden("check_clean.txt", ended.out)
    assert rapidsim("check", "cell.mod", "--ignore", "unused-data", "-q").out == ""


def test_standard_input_is_a_module() -> None:
    ended = rapidsim(
        "check", "-", "--output-format", "concise", stdin=(PROGRAMS / "wrong.mod").read_bytes()
    )
    assert ended.code == 1
    assert all(line.startswith("<stdin>:") for line in ended.out.splitlines()[:-1])


@pytest.mark.parametrize("columns", [1, 20, 1000])
def test_any_width_will_do(columns: int) -> None:
    for command in (("check", "wrong.mod"), ("frames", "cell.mod"), ("robots",)):
        assert rapidsim(*command, columns=columns).code in (0, 1)
