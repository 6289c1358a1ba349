"""`rapidsim run --write-pers`, and what a run says of persistents without it."""

import json
from pathlib import Path

from cli_helper import rapidsim

COUNTS = "MODULE a\n  PERS num n:=1; ! parts\n  PROC main()\n    n:=n+1;\n  ENDPROC\nENDMODULE\n"


def test_a_run_says_what_changed_and_leaves_the_file_alone(tmp_path: Path) -> None:
    file = tmp_path / "a.mod"
    file.write_text(COUNTS)
    ended = rapidsim("run", "a.mod", "--no-record", cwd=tmp_path)
    assert "persistents  n (a) 1 -> 2" in ended.out
    report = json.loads(
        rapidsim("run", "a.mod", "--no-record", "--format", "json", cwd=tmp_path).out
    )
    assert report["persistents"] == [{"name": "n", "module": "a", "old": "1", "new": "2"}]
    assert file.read_text() == COUNTS


def test_values_are_written_where_they_are_declared(tmp_path: Path) -> None:
    file = tmp_path / "a.mod"
    file.write_text(COUNTS)
    ended = rapidsim("run", "a.mod", "--no-record", "--write-pers", cwd=tmp_path)
    assert ended.code == 0
    assert "Written: a.mod (values of persistents)" in ended.out
    assert file.read_text() == COUNTS.replace("n:=1;", "n:=2;")
    again = rapidsim(
        "run", "a.mod", "--no-record", "--write-pers", "--format", "json", cwd=tmp_path
    )
    assert json.loads(again.out)["files"]["program"] == ["a.mod"]
    assert file.read_text() == COUNTS.replace("n:=1;", "n:=3;")


def test_comments_and_lines_between_values_stay(tmp_path: Path) -> None:
    file = tmp_path / "a.mod"
    text = "PERS num n{3}:=[1, ! the first\n    2,\t- 3];"
    file.write_text(f"MODULE a\n  {text}\n  PROC main()\n    n:=[1,7,8];\n  ENDPROC\nENDMODULE\n")
    assert rapidsim("run", "a.mod", "--no-record", "--write-pers", cwd=tmp_path).code == 0
    written = text.replace("2", "7").replace("- 3", "8")
    assert written in file.read_text()


def test_values_are_written_after_an_error_too(tmp_path: Path) -> None:
    file = tmp_path / "a.mod"
    file.write_text(COUNTS.replace("n:=n+1;", "n:=0; n:=1/n;"))
    assert rapidsim("run", "a.mod", "--no-record", "--write-pers", cwd=tmp_path).code == 1
    assert "n:=0; ! parts" in file.read_text()


def test_standard_input_is_refused_before_the_run(tmp_path: Path) -> None:
    ended = rapidsim("run", "-", "--write-pers", cwd=tmp_path, stdin=COUNTS.encode())
    assert (ended.code, ended.out) == (2, "")
    assert "standard input cannot be written to" in ended.err
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_the_program_itself_changed_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.mod"
    file.write_text(
        "MODULE a\n  PERS num n:=1;\n  VAR iodev log;\n  PROC main()\n    n:=2;\n"
        '    Open "HOME:"\\File:="a.mod",log\\Append;\n    Write log,"! seen";\n'
        "    Close log;\n  ENDPROC\nENDMODULE\n"
    )
    ended = rapidsim("run", "a.mod", "--no-record", "--write-pers", "--home", ".", cwd=tmp_path)
    assert ended.code == 2
    assert "a.mod has changed since it was read" in ended.err
    assert "persistents  n (a) 1 -> 2" in ended.out
    assert "PERS num n:=1;" in file.read_text()


def test_a_long_list_of_persistents_is_cut(tmp_path: Path) -> None:
    data = "".join(f"  PERS num n{i}:=0;\n" for i in range(10))
    sets = "".join(f"    n{i}:=1;\n" for i in range(10))
    (tmp_path / "a.mod").write_text(
        f"MODULE a\n{data}  PERS pos p:=[0,0,0];\n  PROC main()\n    p.y:=3;\n{sets}  ENDPROC\n"
        "ENDMODULE\n"
    )
    ended = rapidsim("run", "a.mod", "--no-record", cwd=tmp_path)
    assert "n7 (a) 0 -> 1" in ended.out
    assert "n8" not in ended.out
    assert "and 3 more" in ended.out
