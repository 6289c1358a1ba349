"""Modules that are encoded: the program runs beside them, and knows that they are there."""

from __future__ import annotations

from pathlib import Path

from command_line import call

PROGRAM = """MODULE job
  PROC main()
    IF ModExist("Secret") TPWrite "there";
    IF NOT ModExist("other") TPWrite "the other is not";
    IF ModTime("secret")>0 TPWrite "since the start";
    Save "SECRET"\\FilePath:="HOME:/copy.mod";
    EraseModule "secret";
    Save "other"\\FilePath:="HOME:/other.mod";
  ERROR
    TPWrite "the other cannot be saved";
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_a_task_knows_its_modules_that_cannot_be_read(tmp_path: Path) -> None:
    folder = tmp_path / "task"
    folder.mkdir()
    (folder / "job.mod").write_text(PROGRAM)
    (folder / "secret.mod").write_bytes(bytes(range(256)) * 20)
    (tmp_path / "home").mkdir()
    options = ("--no-record", "--format", "table", "-v", "--home", tmp_path / "home")
    ended = call("run", "task", *options, cwd=tmp_path)
    assert ended.code == 0, ended
    said = [line.split("TPWrite")[-1].strip() for line in ended.out.splitlines()]
    texts = ("there", "the other is not", "since the start", "the other cannot be saved")
    assert [text for text in texts if any(line.endswith(text) for line in said)] == [*texts]
    assert "Save of a module that cannot be read" in ended.out + ended.err
    assert "EraseModule of a module that cannot be read" in ended.out + ended.err
    assert not [*(tmp_path / "home").iterdir()]
