"""Under pytest and in CI, what an earlier run has left in its home folder decides nothing."""

from pathlib import Path

import pytest
from command_line import call

PROGRAM = """MODULE notes
  PROC main()
    VAR iodev log;
    Open "HOME:"\\File:="log.txt", log\\Append;
    Write log, "once";
    Close log;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("variable", ["CI", "PYTEST_CURRENT_TEST"])
def test_the_home_folder_is_fresh(variable: str, tmp_path: Path) -> None:
    (tmp_path / "notes.mod").write_text(PROGRAM)
    command = ("run", "notes.mod", "--no-record")
    environment = {variable: "1"}
    assert call(*command, cwd=tmp_path, environment=environment).err == ""
    second = call(*command, cwd=tmp_path, environment=environment)
    note = "note: HOME: is notes-2.home, a fresh one; `--home notes.home` takes the existing one"
    assert second.err.splitlines() == [note]
    third = call(*command, "--home", "notes.home", cwd=tmp_path, environment=environment)
    assert third.err == ""
    assert call(*command, cwd=tmp_path).err == ""
    lines = {
        one.name: len((one / "log.txt").read_text().split()) for one in tmp_path.glob("*.home")
    }
    assert lines == {"notes.home": 3, "notes-2.home": 1}
