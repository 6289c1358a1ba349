"""`--watch`: a command is repeated when a file changes, whatever the clock does meanwhile."""

from collections.abc import Callable, Iterator
from pathlib import Path

import click
import pytest
from cli_helper import rapidsim

from rapidsim.cli.tools import watch_mode

GOOD = 'MODULE m\nPROC main()\nTPWrite "%s";\nENDPROC\nENDMODULE\n'


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> Callable[[list[Callable[[], object]]], None]:
    """Do one thing at each look, instead of waiting; then leave the loop."""

    def does(things: list[Callable[[], object]]) -> None:
        rest: Iterator[Callable[[], object]] = iter(things)

        def look() -> None:
            thing = next(rest, None)
            if thing is None:
                raise click.exceptions.Exit(99)
            thing()

        monkeypatch.setattr(watch_mode, "wait_for_change", look)

    return does


@pytest.mark.parametrize("name", ["m.mod", "."])
def test_a_check_is_repeated_when_a_file_changes(
    name: str, tmp_path: Path, looks: Callable[[list[Callable[[], object]]], None]
) -> None:
    file = tmp_path / "m.mod"
    file.write_text(GOOD % "a")
    looks(
        [
            lambda: None,
            lambda: file.write_text("MODULE m\nPROC main()\nnowhere;\nENDPROC\nENDMODULE\n"),
            lambda: None,
            lambda: file.write_text(GOOD % "long again"),
        ]
    )
    ended = rapidsim("check", name, "--watch", cwd=tmp_path)
    assert ended.code == 99
    assert ended.out.count("Found nothing wrong") == 2
    assert ended.out.count("Found 1 error") == 1
    assert ended.err.count("Watching 1 file;") == 3
    assert ended.err.count("Changed: m.mod") == 2


def test_a_file_that_is_just_being_written_ends_nothing(
    tmp_path: Path, looks: Callable[[list[Callable[[], object]]], None]
) -> None:
    file = tmp_path / "m.mod"
    file.write_text(GOOD % "first")
    looks([file.unlink, lambda: file.write_text(GOOD % "second")])
    ended = rapidsim("run", "m.mod", "--no-record", "--watch", cwd=tmp_path)
    assert "first" in ended.out
    assert "second" in ended.out
    assert "m.mod does not exist" in ended.err


def test_what_a_program_writes_does_not_start_it_again(
    tmp_path: Path, looks: Callable[[list[Callable[[], object]]], None]
) -> None:
    (tmp_path / "m.mod").write_text(GOOD % "once")
    home = tmp_path / "x.home"
    home.mkdir()
    looks([lambda: (home / "written.mod").write_text("x")])
    ended = rapidsim("run", ".", "--no-record", "--watch", cwd=tmp_path)
    assert ended.out.count("once") == 1


def test_what_cannot_be_watched_is_refused(tmp_path: Path) -> None:
    (tmp_path / "m.mod").write_text(GOOD % "a")
    assert rapidsim("check", "-", "--watch", cwd=tmp_path).code == 2
    assert rapidsim("run", "m.mod", "--watch", "--write-pers", cwd=tmp_path).code == 2
