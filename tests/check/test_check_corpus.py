"""Valid programs as they are written in the field: not one finding is an error."""

from __future__ import annotations

from pathlib import Path

import pytest
from check_helper import CORPUS, found_in, lines

from rapidsim.diagnostics import Severity
from rapidsim.module_files import MODULE_SUFFIXES

REPOSITORY = Path(__file__).parents[2]
# Folders are programs of several modules, a backup of several tasks; other modules stand alone.
PROGRAMS = sorted(CORPUS.iterdir())
LACK_MODULES = {"needs_neighbours.mod", "vision.mod"}
OWN = [REPOSITORY / "programs" / name for name in ("pentagon.mod", "algorithms.mod")]


@pytest.mark.parametrize("program", [*PROGRAMS, *OWN], ids=lambda path: path.name)
def test_a_valid_program_has_no_error(program: Path) -> None:
    found = found_in(program, every_rule=True, assumes=program.name in LACK_MODULES)
    errors = [one for one in found if one.severity is Severity.ERROR]
    assert errors == [], lines(tuple(errors))


def test_every_rule_can_look_at_every_program_of_the_tests(rule_programs: list[Path]) -> None:
    programs = [*sorted(REPOSITORY.glob("tests/**/*.mod")), *rule_programs]
    assert len(programs) > 200
    for program in programs:
        for one in found_in(program, every_rule=True):
            assert one.violation.message


def test_the_corpus_is_as_varied_as_it_says() -> None:
    files = [file for file in CORPUS.rglob("*") if file.suffix in MODULE_SUFFIXES]
    data = [file.read_bytes() for file in files]
    assert len(files) >= 40
    assert {file.suffix for file in files} == {".mod", ".modx", ".sys", ".sysx", ".prg"}
    ends = {(b"\r\n" in text, b"\n" in text.replace(b"\r\n", b"")) for text in data}
    assert len(ends) == 4
    assert any(text.startswith(b"\xef\xbb\xbf") for text in data)
    assert any(text.startswith(b"%%%") for text in data)
    assert {_encoding(text) for text in data} == {"ascii", "utf-8", "single bytes"}


def _encoding(data: bytes) -> str:
    if data.isascii():
        return "ascii"
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "single bytes"
    return "utf-8"


def test_tasks_that_share_a_persistent_agree_on_its_type(tmp_path: Path) -> None:
    for number, of in ((1, "num"), (2, "bool")):
        folder = tmp_path / "RAPID" / f"TASK{number}" / "PROGMOD"
        folder.mkdir(parents=True)
        value = "0" if of == "num" else "FALSE"
        text = f"MODULE m\n  PERS {of} flag:={value};\n  TASK PERS {of} own:={value};\nENDMODULE\n"
        (folder / "m.mod").write_text(text)
    found = found_in(tmp_path)
    assert [(one.violation.code, one.span and one.span.line) for one in found] == [("N208", 2)]
