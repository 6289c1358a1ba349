"""The coverage plugin: RAPID lines counted by coverage.py, in a process of its own."""

import contextlib
import html
import io
import json
import os
import subprocess
import sys
from pathlib import Path
from types import CodeType
from unittest.mock import patch
from xml.etree import ElementTree

import pytest
from coverage import Coverage
from coverage.cmdline import main as coverage_command

from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Source
from rapidsim.interpreter.linking.translation import translate
from rapidsim.interpreter.tools.executable_lines import routine_lines
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse

PROGRAMS = sorted((Path(__file__).parents[2] / "programs").glob("*.mod"))

# A comment at the end of a line says whether the line counts, and whether it is executed.
MARKED = """MODULE marked
  VAR num parts := 2;
  CONST num sizes{2} := [1, 2];
  PROC main()
    VAR num n;                      ! run
    CONST num most := 3;
    FOR i FROM 1 TO 2 DO            ! run
      n := n                        ! run
        + sizes{i};
    ENDFOR
    IF n = 100 THEN                 ! run
      TPWrite "never";              ! missed
    ELSEIF
      n = 3 THEN                    ! run
      TPWrite "three";              ! run
    ELSE
      TPWrite "never";              ! missed
    ENDIF
    IF n = 100                      ! run
      TPWrite "never";              ! missed
    TEST n                          ! run
    CASE 1, 2:                      ! run
      TPWrite "never";              ! missed
    CASE 3:                         ! run
      TPWrite "three";              ! run
    CASE 4:                         ! missed
      TPWrite "never";              ! missed
    DEFAULT:
      TPWrite "never";              ! missed
    ENDTEST
    WHILE n > most DO               ! run
      n := 0;                       ! missed
    ENDWHILE
    again:
    n := n + 1;                     ! run
    IF n < 6 GOTO again;            ! run
    weld;                           ! run
    RETURN;                         ! run
    TPWrite "behind the end";       ! missed
  ENDPROC
  PROC weld()
    VAR num n := 1;                 ! run
    n := n / (parts - 2);           ! run
  BACKWARD
    TPWrite "backwards";
  ERROR
    IF ERRNO <> ERR_DIVZERO THEN    ! run
      RAISE;                        ! missed
    ENDIF
    parts := 3;                     ! run
    RETRY;                          ! run
  UNDO
    TPWrite "undone";               ! missed
  ENDPROC
  PROC unused()
    %"main"%;                       ! missed
  ENDPROC
ENDMODULE
"""


def marked(mark: str) -> set[int]:
    lines = enumerate(MARKED.splitlines(), 1)
    return {line for line, text in lines if text.endswith(f"! {mark}")}


def executable(file: tree.File) -> set[int]:
    return {line for routine in routine_lines(file) for line in routine.executable}


def test_the_lines_that_count_are_those_that_hold_statements() -> None:
    file = parse(Source("marked.mod", MARKED)).file
    assert executable(file) == marked("run") | marked("missed")


def test_routines_have_their_lines() -> None:
    file = parse(Source("marked.mod", MARKED)).file
    found = {routine.name: (routine.first, routine.last) for routine in routine_lines(file)}
    text = MARKED.splitlines()
    assert list(found) == ["main", "weld", "unused"]
    assert all(text[last - 1].strip() == "ENDPROC" for _, last in found.values())


def statement_lines(code: CodeType) -> set[int]:
    """The lines of all functions in a code object, without those of their headers."""
    lines = set()
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            lines |= {line for *_, line in inner.co_lines() if line} - {inner.co_firstlineno}
            lines |= statement_lines(inner)
    return lines


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.stem)
def test_the_tree_and_the_code_name_the_same_lines(program: Path) -> None:
    """But for initial values, and ends of functions, where a missing RETURN is an error."""
    source = Source(program.name, program.read_text("utf-8"))
    file = parse(source).file
    checked = check([file])
    assert checked.program is not None
    (translated,) = translate(checked.program).modules
    module = translated.module
    functions = (item for item in module.routines if isinstance(item, tree.Func))
    data = (item for item in module.items if isinstance(item, tree.Data))
    other = {source.position(function.end - 1)[0] for function in functions}
    other |= {source.position(item.start)[0] for item in data}
    code = compile(translated.code, program.name, "exec")
    assert statement_lines(code) - other == executable(file)


CONFIGURATION = "[run]\nplugins = rapidsim.interpreter.tools.coverage_plugin\n"


def coverage(folder: Path, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "coverage", *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "COVERAGE_FILE": str(folder / ".coverage")},
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def report(folder: Path, *arguments: str) -> str:
    """The same for what reads the data of a run, which needs no process of its own."""
    out = io.StringIO()
    with (
        contextlib.chdir(folder),
        contextlib.redirect_stdout(out),
        patch.dict(os.environ, {"COVERAGE_FILE": str(folder / ".coverage")}),
    ):
        code = coverage_command([*arguments])
    assert code in (0, None), out.getvalue()
    return out.getvalue()


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the data of a run; the module is not UTF-8 and has odd line ends."""
    folder = tmp_path_factory.mktemp("measured")
    text = MARKED.replace("three", "drei für").replace("\n", "\r\r\n")
    (folder / "marked.mod").write_bytes(text.encode("cp1252"))
    (folder / ".coveragerc").write_text(CONFIGURATION)
    program = ("-m", "rapidsim", "run", "marked.mod", "--no-record", "-q")
    said = coverage(folder, "run", "--rcfile=.coveragerc", *program)
    assert "Warning" not in said
    return folder


def test_json_names_the_lines_that_ran(measured: Path) -> None:
    report(measured, "json", "-q")
    found = json.loads((measured / "coverage.json").read_text())
    assert list(found["files"]) == ["marked.mod"]
    file = found["files"]["marked.mod"]
    assert set(file["executed_lines"]) == marked("run")
    assert set(file["missing_lines"]) == marked("missed")
    assert {name for name in file["routines"] if name} == {"main", "weld", "unused"}


def test_text_html_xml_and_lcov(measured: Path) -> None:
    run, missed = len(marked("run")), len(marked("missed"))
    text = report(measured, "report", "-m")
    assert f"{run + missed:>7} {missed:>6}" in text
    report(measured, "html", "-q")
    (page,) = (measured / "htmlcov").glob("marked_mod.html")
    shown = page.read_text("utf-8")
    assert shown.count('class="mis show_mis"') == missed
    assert "für" in html.unescape(shown)
    report(measured, "xml", "-q")
    parsed = ElementTree.parse(measured / "coverage.xml")
    hits = {int(line.attrib["number"]): line.attrib["hits"] for line in parsed.iter("line")}
    assert {line for line, count in hits.items() if count == "1"} == marked("run")
    report(measured, "lcov", "-q")
    lcov = (measured / "coverage.lcov").read_text()
    assert f"LH:{run}" in lcov
    assert "FNDA:0,unused" in lcov


def test_a_source_folder_shows_modules_that_never_ran(tmp_path: Path) -> None:
    empty = 'MODULE {0}s\n  PROC {0}()\n    TPWrite "a";\n  ENDPROC\nENDMODULE\n'
    for name in ("main", "spare"):
        (tmp_path / f"{name}.MOD").write_text(empty.format(name))
    (tmp_path / ".coveragerc").write_text(f"{CONFIGURATION}source = .\n")
    coverage(tmp_path, "run", "-m", "rapidsim", "run", "main.MOD", "--no-record", "-q")
    shown = report(tmp_path, "report")
    assert [line.split() for line in shown.splitlines() if ".MOD" in line] == [
        ["main.MOD", "1", "0", "100%"],
        ["spare.MOD", "1", "1", "0%"],
    ]


def test_branches_are_said_not_to_be_measured(tmp_path: Path) -> None:
    (tmp_path / "a.mod").write_text("MODULE a\n  PROC main()\n    ;\n  ENDPROC\nENDMODULE\n")
    (tmp_path / ".coveragerc").write_text(f"{CONFIGURATION}branch = true\n")
    said = coverage(tmp_path, "run", "-m", "rapidsim", "run", "a.mod", "--no-record", "-q")
    assert "rapidsim measures lines of RAPID, no branches" in said


@pytest.mark.parametrize(("chosen", "core"), [("", "ctrace"), ("core = pytrace\n", "pytrace")])
def test_the_tracer_is_the_one_that_supports_plugins_unless_another_is_chosen(
    tmp_path: Path, chosen: str, core: str
) -> None:
    rcfile = tmp_path / ".coveragerc"
    rcfile.write_text(CONFIGURATION + chosen)
    measurement = Coverage(config_file=str(rcfile), data_file=None)
    measurement.get_data()
    assert measurement.get_option("run:core") == core
