"""Names and their symbols: each name is found at its place, and a rename keeps the program."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest
from laws import cases, some
from whole_findings import assert_section

from rapidsim.analysis.cell_names import NO_CELL, CellNames, ConfiguredSymbol
from rapidsim.analysis.names.name_violations import DuplicateName
from rapidsim.analysis.occurrences.locate import locate, name_at, names_in
from rapidsim.analysis.occurrences.names import NamesOfNodes, Occurrence, declared_name
from rapidsim.analysis.occurrences.rename import RenameRefusedError, plan_rename
from rapidsim.analysis.occurrences.scopes import symbols_in_scope
from rapidsim.analysis.occurrences.search import occurrences
from rapidsim.files import SourceFile
from rapidsim.language.types import SIGNAL_DO
from rapidsim.module_files import TaskFiles
from rapidsim.text_edits import edited_text
from rapidsim.workspace.workspace import Workspace

ROOT = Path(__file__).parents[2]
FILES = sorted([*(ROOT / "programs").rglob("*.mod"), *(ROOT / "tests" / "rapid").rglob("*.mod")])
ABOUT_NAMES = ("E108", "E121", "N202", "N203", "N204", "N206")
"""Findings that a rename removes, because they are about the old name."""

CELL = CellNames(symbols={"dogrip": ConfiguredSymbol("doGrip", SIGNAL_DO)})


def workspace_of(text: str) -> Workspace:
    return Workspace([TaskFiles(None, (SourceFile("m.mod", text, "utf-8"),))])


def names_of(workspace: Workspace) -> tuple[list[Occurrence], NamesOfNodes]:
    names = NamesOfNodes(workspace.facts("m.mod"))
    modules = workspace.file("m.mod").modules
    return [one for module in modules for one in names_in(module, module, names)], names


def read(path: Path) -> str:
    return path.read_bytes().decode("latin-1")


@pytest.mark.parametrize("path", some(FILES, 10), ids=lambda path: path.stem)
def test_every_name_is_found_at_its_place(path: Path) -> None:
    workspace = workspace_of(read(path))
    found, names = names_of(workspace)
    file = workspace.file("m.mod")
    for one in found:
        assert name_at(file, one.name.start, names) == one
        assert name_at(file, one.name.end, names) == one
        declared = None if one.symbol is None else declared_name(one.symbol, names.facts)
        if one.is_declaration and declared is not None and not _is_repeated(one, found):
            assert declared[1] is one.name
    for symbol in {one.symbol for one in found if one.symbol is not None}:
        listed = [one for one in found if one.symbol == symbol and _is_spelled(one)]
        assert sorted(one.name.start for one in occurrences(symbol, names)) == sorted(
            one.name.start for one in listed
        )


def _is_repeated(one: Occurrence, found: list[Occurrence]) -> bool:
    """Whether a component or module is declared twice, which is an error."""
    same = [other for other in found if other.is_declaration and other.symbol == one.symbol]
    return len(same) > 1


def _is_spelled(one: Occurrence) -> bool:
    """Whether the text has the name as a word, which a repair may have corrected."""
    span = one.module.span(one.name)
    before = span.source.text[span.start - 1 : span.start]
    return span.text == one.name.text and not before.isalnum()


def test_a_rename_changes_no_finding_and_can_be_taken_back() -> None:
    chance = random.Random(5)
    renamed = 0
    for path in chance.sample(FILES, min(len(FILES), cases(250))):
        text = read(path)
        workspace = workspace_of(text)
        found, names = names_of(workspace)
        symbols = sorted(
            {one.symbol for one in found if one.symbol is not None}, key=lambda one: one.name
        )
        for symbol in chance.sample(symbols, min(4, len(symbols))):
            new = f"zq_{symbol.name[:20]}_k"
            try:
                plan = plan_rename(symbol, new, names)
            except RenameRefusedError:
                continue
            after = workspace_of(
                edited_text(text, [(span.start, span.end, new) for span in plan.spans])
            )
            assert _lines(after) == _lines(workspace), (path, symbol.name)
            renamed += 1
            place = plan.spans[0].start
            address = after.file("m.mod").source.address(place)
            again = NamesOfNodes(after.facts("m.mod"))
            there = name_at(after.file("m.mod"), address, again)
            assert there is not None
            try:
                back = plan_rename(there.symbol, symbol.name, again)
            except RenameRefusedError:
                # The old name hid another one, or was the name of something else, too.
                continue
            edits = [(span.start, span.end, symbol.name) for span in back.spans]
            taken_back = edited_text(after.text("m.mod"), edits)
            assert taken_back.lower() == text.lower()
    assert renamed > cases(250)


def _lines(workspace: Workspace) -> Counter[tuple[str, int | None]]:
    """Codes and lines of the findings, but for those about names."""
    return Counter(
        (one.code, one.line)
        for one in workspace.findings("m.mod")
        if one.code not in ABOUT_NAMES and not isinstance(one.violation, DuplicateName)
    )


def test_scopes_are_from_the_inside_outwards() -> None:
    text = (
        "MODULE m\n  VAR num a;\n  VAR num b;\n  PROC p(num a\\num o|switch w)\n    VAR num c;\n"
        "    FOR i FROM 1 TO 2 DO\n      c:=a;\n    ENDFOR\n    SetDO doNew,1;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    files = (SourceFile("m.mod", text, "utf-8"),)
    workspace = Workspace([TaskFiles(None, files)], cell=CELL)
    file, facts = workspace.file("m.mod"), workspace.facts("m.mod")
    location = locate(file, file.source.address(text.index("c:=a")))
    assert location is not None
    found = list(symbols_in_scope(location, facts))
    names = "i a o w c b p doGrip doNew"
    assert [one.name for one in found] == names.split()
    assert type(found[1]).__name__ == "ParameterSymbol"


@pytest.mark.parametrize(
    ("text", "new", "reason"),
    [
        # A loop elsewhere may have a counter of that name, one around may not.
        ("FOR k FROM 1 TO 2 DO\nENDFOR\nFOR i FROM 1 TO 2 DO\nENDFOR", "i", None),
        ("FOR i FROM 1 TO 2 DO\nFOR k FROM 1 TO 2 DO\nENDFOR\nENDFOR", "i", "is declared"),
        ("FOR k FROM 1 TO 2 DO\nx:=1;\nENDFOR", "x", "name of a variable"),
    ],
)
def test_counters(text: str, new: str, reason: str | None) -> None:
    program = f"MODULE m\nVAR num x;\nPROC main()\n{text}\nENDPROC\nENDMODULE\n"
    found, names = names_of(workspace_of(program))
    symbol = next(one.symbol for one in found if one.name.text == "k")
    if reason is None:
        assert len(plan_rename(symbol, new, names).spans) == 1
        return
    with pytest.raises(RenameRefusedError, match=reason):
        plan_rename(symbol, new, names)


def test_a_rename_in_several_modules() -> None:
    one = "MODULE a\n  PERS num total:=1;\nENDMODULE\n"
    other = "MODULE b\n  PROC main()\n    total:=TOTAL+1;\n  ENDPROC\nENDMODULE\n"
    files = (SourceFile("a.mod", one, "utf-8"), SourceFile("b.mod", other, "utf-8"))
    workspace = Workspace([TaskFiles(None, files)])
    names = NamesOfNodes(workspace.facts("a.mod"))
    symbol = next(
        found.symbol
        for module in workspace.file("a.mod").modules
        for found in names_in(module, module, names)
        if found.name.text == "total"
    )
    plan = plan_rename(symbol, "sum", names)
    assert [span.file for span in plan.spans] == ["a.mod", "b.mod", "b.mod"]


KINDS = """MODULE m
  ALIAS num length;
  RECORD part
    length width;
    robtarget place;
  ENDRECORD
  CONST num limit:=3;
  PERS part one;
  LOCAL VAR part many{2};
  VAR intnum i1;
  PROC main()
    VAR num own:=1;
    again:
    FOR k FROM 1 TO limit DO
      many{k}.width:=one.width+own+nowhere;
      go own\\by:=k\\quick;
      go own\\by?own;
    ENDFOR
    MoveJ one.place,v50,fine,tool0\\WObj:=wobj0;
    IF own<reg1 GOTO again;
    SetDO doGrip,1;
    CONNECT i1 WITH stops;
    %"go"%;
  ENDPROC
  LOCAL PROC go(INOUT num x\\num by|switch quick)
    VAR num limit;
    IF Present(by) limit:=x+by+twice(x);
  ENDPROC
  FUNC num twice(num x)
    RETURN 2*x;
  ENDFUNC
  TRAP stops
    own2:=1;
  ENDTRAP
ENDMODULE
"""
NEW = (
    *("fresh", "own", "x", "limit", "go", "part", "width", "place", "m", "k", "many", "again"),
    *("MoveJ", "num", "v50", "while", "1a", "a" * 33, "OWN", "doGrip", "by", "nowhere"),
)


FAULTY = """MODULE m
  RECORD part
    num width;
    num width;
    place place;
  ENDRECORD
  LOCAL VAR num twice;
  VAR num twice;
  VAR robtarget p;
  VAR part one;
  VAR part all{2};
  LOCAL PERS num kept:=1;
  PROC main()
    VAR num own;
    VAR num own;
    VAR string s;
    GOTO nowhere;
    p.trans.x:=p.trans.length+one.none;
    all{1}.width:=all.width;
    go own\\other:=1;
    go x:=own,\\by:=own;
    nobody own\\by:=1;
    doGrip:=1;
    SetDO doGrip,1;
    own:=s;
    TPWrite s\\Num:=own\\Wrong:=1;
    p:=Offs(p,1,2,3);
    %s+"go"%;
    %"kept:m"%;
    TPWrite [s];
    IF own ) THEN ( broken;
  ENDPROC
  PROC go(num x\\num by)
    VAR num own;
    x:=own+by;
    own.x:=1;
  ENDPROC
  FUNC part golden(part given)
    RETURN given;
  ENDFUNC
ENDMODULE
MODULE other
  LOCAL VAR num kept;
  LOCAL PROC go()
    kept:=twice;
    m:go 1;
  ENDPROC
ENDMODULE
"""
NEW_IN_FAULTY = ("fresh", "doGrip", "broken", "kept", "twice", "own", "other", "by", "x")


def renames(text: str, news: Sequence[str], cell: CellNames = NO_CELL) -> str:
    """What each name of a text may become, and why not: a line for each answer."""
    files = (SourceFile("m.mod", text, "utf-8"),)
    found, names = names_of(Workspace([TaskFiles(None, files)], cell=cell))
    told = []
    for one in {(one.symbol, one.name.key): one for one in found}.values():
        kind = type(one.symbol).__name__.removesuffix("Symbol")
        declared = None if one.symbol is None else declared_name(one.symbol, names.facts)
        at = "" if declared is None else f" of {one.module.span(declared[1]).line}"
        told.append(f"{kind} {one.name.text}{at}\n")
        answers: dict[str, list[str]] = {}
        for new in news:
            try:
                spans = plan_rename(one.symbol, new, names).spans
            except RenameRefusedError as error:
                answer = str(error).replace(f"`{new}`", "it")
            else:
                answer = " ".join(f"{at.line}:{at.column}" for at in spans)
            answers.setdefault(answer, []).append(new)
        told += (f"  {' '.join(news)}: {answer}\n" for answer, news in answers.items())
    return "".join(told)


def test_what_each_name_may_become() -> None:
    text = renames(KINDS, NEW)
    assert_section(Path(__file__).with_name("renames.txt"), "renames", text)


def test_what_each_name_may_become_among_errors() -> None:
    text = renames(FAULTY, NEW_IN_FAULTY, CELL)
    assert_section(Path(__file__).with_name("renames.txt"), "renames among errors", text)
