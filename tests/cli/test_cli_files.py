"""What PATH may be, and that bytes of any kind become text."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.files import InputError, decode, did_you_mean
from rapidsim.module_files import read_tasks

MODULE = "MODULE {0}\nENDMODULE\n"


def write(folder: Path, *names: str) -> None:
    for name in names:
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(MODULE.format(file.stem))


def names(*tasks_of: Path | str) -> list[list[str]]:
    tasks = read_tasks([str(path) for path in tasks_of])
    return [[Path(file.name).name for file in task.files] for task in tasks]


def test_a_folder_is_one_task_of_all_its_modules(tmp_path: Path) -> None:
    write(tmp_path, "b.MOD", "a.mod", "User.sys", "c.prg", "d.modx", "e.sysx", "notes.txt")
    assert names(tmp_path) == [["a.mod", "b.MOD", "c.prg", "d.modx", "e.sysx", "User.sys"]]


def test_a_backup_is_a_task_for_each_task_folder(tmp_path: Path) -> None:
    write(tmp_path, "RAPID/TASK10/SYSMOD/user.sys", "RAPID/TASK2/PROGMOD/main.mod")
    write(tmp_path, "RAPID/TASK2/SYSMOD/base.sys", "SYSPAR/EIO.cfg")
    assert names(tmp_path) == [["main.mod", "base.sys"], ["user.sys"]]
    assert names(tmp_path / "RAPID") == names(tmp_path)
    assert [task.name for task in read_tasks([str(tmp_path)])] == ["TASK2", "TASK10"]
    assert names(tmp_path / "RAPID" / "TASK2") == [["main.mod", "base.sys"]]


def test_files_named_together_are_one_task_and_named_twice_are_read_once(tmp_path: Path) -> None:
    write(tmp_path, "a.mod", "b.mod")
    assert names(tmp_path / "b.mod", tmp_path, tmp_path / "b.mod") == [["b.mod", "a.mod"]]


def test_a_program_file_lists_its_neighbours_in_any_case(tmp_path: Path) -> None:
    write(tmp_path, "MainModule.mod", "CalibData.mod", "other.mod")
    (tmp_path / "p.pgf").write_text(
        '<?xml version="1.0" encoding="ISO-8859-1" ?>\n<Program>\n'
        "\t<Module>mainmodule.mod</Module>\n\t<Module>CalibData.mod</Module>\n</Program>\n"
    )
    assert names(tmp_path / "p.pgf") == [["MainModule.mod", "CalibData.mod"]]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("<Program></Program>", "lists no module"),
        ("<Program><Module>a.mod</Program>", "is not a program file"),
        ("<Program><Module>../a.mod</Module></Program>", "is not in the same folder"),
        ("<Program><Module>/etc/passwd</Module></Program>", "is not in the same folder"),
        ("<Program><Module>b.mod</Module></Program>", "lists b.mod, which is missing"),
        (
            '<!DOCTYPE p [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><Program>'
            "<Module>&b;.mod</Module></Program>",
            "declares a document type",
        ),
        ('<?xml version="1.0" encoding="klingon"?><Program/>', "is not a program file"),
    ],
)
def test_a_bad_program_file_says_why(text: str, part: str, tmp_path: Path) -> None:
    write(tmp_path, "a.mod")
    (tmp_path / "p.pgf").write_text(text)
    with pytest.raises(InputError) as raised:
        read_tasks([str(tmp_path / "p.pgf")])
    assert part in raised.value.message


@pytest.mark.parametrize(
    ("data", "text", "encoding"),
    [
        (b"plain", "plain", "utf-8"),
        ("Größe".encode(), "Größe", "utf-8"),
        (b"\xef\xbb\xbfMODULE", "MODULE", "utf-8"),
        ("Größe".encode("latin-1"), "Größe", "cp1252"),
        ("5 €".encode("cp1252"), "5 €", "cp1252"),
        (b"\x81\xff", "\x81ÿ", "latin-1"),
        (b"\xff\xfeM\x00", "M", "utf-16-le"),
        (b"\xfe\xff\x00M", "M", "utf-16-be"),
        (b"", "", "utf-8"),
    ],
)
def test_encodings(data: bytes, text: str, encoding: str) -> None:
    assert decode(data) == (text, encoding)


@given(st.binary())
def test_any_bytes_become_text(data: bytes) -> None:
    text, _ = decode(data)
    assert isinstance(text, str)


def test_near_names_ignore_case() -> None:
    assert did_you_mean("IRB12O", ["irb120", "irb1600"]) == "did you mean `irb120`?"
    assert did_you_mean("IRB1X0", ["irb120", "irb140"]) == "did you mean `irb140` or `irb120`?"
    assert did_you_mean("qqq", ["irb120"]) is None
