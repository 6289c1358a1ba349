"""New values of persistents in the program's files: only their text changes."""

from pathlib import Path

import pytest

from rapidsim.export.persistents import write_persistents
from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.module_files import read_tasks
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.persistents import PersistentChange
from rapidsim.simulation.simulate import simulate

ROBOT = load_robot("irb1600")
Run = tuple[tuple[PersistentChange, ...], tuple[SourceFile, ...]]


def run(folder: Path, data: bytes) -> Run:
    path = folder / "cell.mod"
    path.write_bytes(data)
    (task,) = read_tasks([str(path)])
    program = load(task.files).program
    assert program is not None
    return simulate(program, ROBOT, options=RunOptions()).persistents, task.files


def written(folder: Path, data: bytes) -> bytes:
    write_persistents(*run(folder, data))
    assert [entry.name for entry in folder.iterdir()] == ["cell.mod"]
    return (folder / "cell.mod").read_bytes()


def cell(declaration: str, statements: str = "") -> bytes:
    main = f"  PROC main()\n    {statements}\n  ENDPROC\n"
    return f"MODULE cell\n  {declaration} ! said\n{main}ENDMODULE\n".encode()


@pytest.mark.parametrize(
    ("before", "statement", "after"),
    [
        ("PERS num n:=3;", "n:=n+1;", "PERS num n:=4;"),
        ("PERS num n := 3 ;", "n:=-n;", "PERS num n := -3 ;"),
        ("PERS num n;", "n:=5;", "PERS num n:=5;"),
        ("PERS num n{2};", "n{2}:=5;", "PERS num n{2}:=[0,5];"),
        ("PERS num n:=1;", "n:=16777216/3;", "PERS num n:=5592405.5;"),
        ("PERS num n:=1;", "n:=1/3;", "PERS num n:=0.33333334;"),
        ("PERS num n:=1;", "n:=1E30;", "PERS num n:=1E+30;"),
        # Sums are not checked for the range of num, so that loops are quick.
        ("PERS num n:=2E38;", "n:=n+n;", "PERS num n:=4E+38;"),
        ("PERS dnum d:=1;", "d:=1/3;", "PERS dnum d:=0.3333333333333333;"),
        ("PERS dnum d:=1;", "d:=4294967295;", "PERS dnum d:=4294967295;"),
        ("PERS bool b:=FALSE;", "b:=TRUE;", "PERS bool b:=TRUE;"),
        ('PERS string s:="a";', r's:="""\\\0D\E9";', r'PERS string s:="""\\\0D\E9";'),
        ("PERS pos p:=[1, 2.50,3];", "p.z:=4;", "PERS pos p:=[1, 2.50,4];"),
        ("PERS pos p:=[1,2,3];", "p:=[7,8,9];", "PERS pos p:=[7,8,9];"),
        ("LOCAL PERS num n:=1;", "n:=2;", "LOCAL PERS num n:=2;"),
        ("TASK PERS num n:=1;", "n:=2;", "TASK PERS num n:=2;"),
        ("PERS pos p{2}:=[[1,2,3],[4,5,6]];", "p{2}.x:=-4;", "PERS pos p{2}:=[[1,2,3],[-4,5,6]];"),
        ("PERS num n:=3;", "n:=n+1; n:=n-1;", "PERS num n:=3;"),
        ("VAR num n:=3;", "n:=4;", "VAR num n:=3;"),
    ],
)
def test_only_the_value_changes(before: str, statement: str, after: str, tmp_path: Path) -> None:
    assert written(tmp_path, cell(before, statement)) == cell(after, statement)


def test_a_second_run_starts_where_the_first_ended(tmp_path: Path) -> None:
    data = cell("PERS num n:=1;", "n:=n/3;")
    (first,), files = run(tmp_path, data)
    write_persistents((first,), files)
    (second,), _ = run(tmp_path, (tmp_path / "cell.mod").read_bytes())
    assert second.old == first.new


def test_comments_and_layout_inside_a_value_stay(tmp_path: Path) -> None:
    before = b"MODULE c\r\n PERS num n{3}:=[1, ! one ]\r\n   +2,\t! two\r\r\n   3];\r\n"
    rest = b" PROC main() n{2}:=20; ENDPROC\r\nENDMODULE"
    after = before.replace(b"+2", b"20")
    assert written(tmp_path, before + rest) == after + rest


@pytest.mark.parametrize(
    ("mark", "encoding"),
    [
        (b"", "utf-8"),
        (b"\xef\xbb\xbf", "utf-8"),
        (b"", "cp1252"),
        (b"\xff\xfe", "utf-16-le"),
        (b"\xfe\xff", "utf-16-be"),
    ],
)
def test_encoding_and_byte_order_mark_stay(mark: bytes, encoding: str, tmp_path: Path) -> None:
    before = cell('PERS string s:="Größe";', 's:="Maß";').decode()
    after = before.replace('"Größe"', '"Maß"')
    data = written(tmp_path, mark + before.encode(encoding))
    assert data == mark + after.encode(encoding)


def test_nothing_is_written_where_nothing_changed(tmp_path: Path) -> None:
    changes, files = run(tmp_path, cell("PERS num n:=3;"))
    (tmp_path / "cell.mod").unlink()
    assert write_persistents(changes, files) == ()


def test_a_file_that_changed_meanwhile_is_refused(tmp_path: Path) -> None:
    changes, files = run(tmp_path, cell("PERS num n:=3;", "n:=4;"))
    (tmp_path / "cell.mod").write_bytes(cell("PERS num n:=30;", "n:=4;"))
    with pytest.raises(InputError, match="has changed since it was read"):
        write_persistents(changes, files)
    assert b"n:=30;" in (tmp_path / "cell.mod").read_bytes()


def test_a_file_that_is_gone_is_refused(tmp_path: Path) -> None:
    changes, files = run(tmp_path, cell("PERS num n:=3;", "n:=4;"))
    (tmp_path / "cell.mod").unlink()
    with pytest.raises(InputError, match="does not exist"):
        write_persistents(changes, files)


def test_a_character_that_the_encoding_lacks_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cell.mod"
    other = tmp_path / "other.mod"
    path.write_bytes(
        b'MODULE cell\n PERS string s:="\xe9";\n PROC main() s:=name; ENDPROC\nENDMODULE'
    )
    other.write_text('MODULE other\n CONST string name:="\u03b1";\nENDMODULE', encoding="utf-8")
    (task,) = read_tasks([str(path), str(other)])
    program = load(task.files).program
    assert program is not None
    changes = simulate(program, ROBOT, options=RunOptions()).persistents
    with pytest.raises(InputError, match="which has no character"):
        write_persistents(changes, task.files)
    assert b'"\xe9"' in path.read_bytes()


def test_the_file_keeps_its_permissions_and_a_link_stays_a_link(tmp_path: Path) -> None:
    folder = tmp_path / "cell"
    folder.mkdir()
    target = tmp_path / "shared.mod"
    target.write_bytes(cell("PERS num n:=3;", "n:=4;"))
    target.chmod(0o640)
    link = folder / "cell.mod"
    link.symlink_to(target)
    (task,) = read_tasks([str(link)])
    program = load(task.files).program
    assert program is not None
    write_persistents(simulate(program, ROBOT, options=RunOptions()).persistents, task.files)
    assert link.is_symlink()
    assert b"n:=4;" in target.read_bytes()
    assert target.stat().st_mode & 0o777 == 0o640
