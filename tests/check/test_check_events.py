"""A finding cites the controller's event of its case, and every event that is cited has a title."""

import re
from itertools import chain
from pathlib import Path

import pytest
from command_line import call

from rapidsim.analysis.cell_names import CellNames
from rapidsim.diagnostics import all_rules
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.error_numbers import EVENTS, NUMBERS
from rapidsim.language.events import EVENT_TITLES

MODULE = r"""MODULE m
  CONST robtarget p:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num c:=1;
  VAR num v;
  VAR num a{3};
  VAR bool b;
  VAR string s;
  VAR clock k;
  PERS num q:=1;
  RECORD pair
    num one;
    num two;
  ENDRECORD
  VAR pair both;
  VAR intnum i;
  @declared
  PROC main()
    @
  ENDPROC
  PROC go(num n\num o\switch w|switch x)
  ENDPROC
  PROC changes(INOUT num n)
  ENDPROC
  PROC keeps(PERS num n)
  ENDPROC
  FUNC num f(num n)
    RETURN n;
  ENDFUNC
ENDMODULE
"""
CASES = [
    ("go;", "T302", 40013),
    ("go 1,2;", "T302", 40014),
    (r"go \o:=1,1;", "T302", 40007),
    ("MoveJ p,fine,v10,tool0;", "T302", 40101),
    (r"go 1\w\w;", "T315", 40001),
    (r"go 1\w\x;", "T315", 40002),
    (r"go 1\o;", "T315", 40006),
    (r"go 1\w:=TRUE;", "T315", 40012),
    (r"go 1\o?v;", "T315", 40077),
    (r"go 1\z;", "T312", 40087),
    ("changes 1;", "T303", 40005),
    ("keeps v;", "T303", 40123),
    ("c:=2;", "T304", 40093),
    ("both:=[1];", "T305", 40067),
    ("both:=[1,2,3];", "T305", 40068),
    ("a:=[1,2];", "T305", 40054),
    ('v:="a";', "T301", 40101),
    ("v:=[1,2];", "T301", 40102),
    ("v:=v+s;", "T313", 40050),
    ("v:=v*s;", "T313", 40022),
    ("v:=v DIV s;", "T313", 40027),
    ("b:=v=s;", "T313", 40051),
    ("b:=v<s;", "T313", 40029),
    ("b:=NOT v;", "T313", 40033),
    ("b:=b AND v;", "T313", 40034),
    ("v:=-s;", "T313", 40025),
    ("v:=a{1,2};", "T314", 40036),
    ("v:=v{1};", "T314", 40017),
    ("k:=k;", "T318", 40055),
    ("b:=k=k;", "T318", 40056),
    ("v:=both.three;", "N212", 40089),
    ("nobody;", "N209", 40130),
    ("v:=nobody(1);", "N209", 40129),
    ("v:=nobody;", "N201", 40128),
    ("CONNECT i WITH nobody;", "N201", 40131),
    ("v:=f;", "N211", 40074),
    ("v:=main();", "N211", 40075),
    ("f 1;", "N211", 40079),
    ("RETRY;", "F406", 40096),
    ("TRYNEXT;", "F406", 40097),
    ("RAISE;", "F406", 40095),
    ("RETURN 1;", "F415", 40052),
    ("GOTO nowhere;", "F405", 40086),
    ("CONNECT i WITH main;", "F416", 40081),
]
DECLARED = [
    ("VAR nothing n1;", "N210", 40092),
    ("VAR num v;", "N202", 40043),
    ("CONST num v:=1;", "N202", 40040),
    ("PERS num v:=1;", "N202", 40041),
    ("LOCAL VAR num v;", "N202", 40049),
    ("RECORD pair\n num x;\n ENDRECORD", "N202", 40111),
    ("PROC main()\n ENDPROC", "N202", 40042),
    ("PROC two(num x,num x)\n ENDPROC", "N202", 40046),
    ("VAR num big{0};", "T317", 40015),
    ("VAR num four{1,1,1,1};", "T317", 40016),
    ("VAR num some{v};", "T317", 40020),
    ("CONST num r1:=r2;\n CONST num r2:=r1;", "T322", 40106),
    ("RECORD rec\n rec inner;\n ENDRECORD", "T322", 40109),
    ("PROC own()\n PERS num y:=1;\n ENDPROC", "N213", 40094),
    ("FUNC num none()\n RETURN;\n ENDFUNC", "F415", 40021),
    ("PROC opt(switch on)\n ENDPROC", "T320", 40100),
]


def events(text: str, code: str, cell: CellNames) -> set[str | None]:
    found = load([SourceFile("m.mod", text, "utf-8")], cell=cell).diagnostics
    return {one.violation.cf for one in found if one.code == code}


@pytest.mark.parametrize(("statement", "code", "number"), CASES)
def test_a_statement(statement: str, code: str, number: int) -> None:
    text = MODULE.replace("@declared", "").replace("@", statement)
    assert events(text, code, CellNames()) == {f"ABB {number}"}


@pytest.mark.parametrize(("declaration", "code", "number"), DECLARED)
def test_a_declaration(declaration: str, code: str, number: int) -> None:
    text = MODULE.replace("@declared", declaration).replace("@", "")
    assert events(text, code, CellNames()) == {f"ABB {number}"}


def test_what_a_run_may_reach_has_the_events_of_a_run() -> None:
    late = CellNames(refers_late=True)
    for statement, code, number in (
        ("nobody;", "N209", 40168),
        ("v:=nobody(1);", "N209", 40166),
        ("v:=nobody;", "N221", 40165),
    ):
        text = MODULE.replace("@declared", "").replace("@", statement)
        loaded = load([SourceFile("m.mod", text, "utf-8")], cell=late, refers_late=True)
        assert {one.violation.cf for one in loaded.diagnostics if one.code == code} == {
            f"ABB {number}"
        }


def test_every_cited_event_has_a_title() -> None:
    cited = chain.from_iterable(rule.events.values() for rule in all_rules())
    numbers = {int(re.fullmatch(r"ABB (\d+)", event)[1]) for event in cited}  # type: ignore[index]
    assert numbers | set(EVENTS.values()) <= EVENT_TITLES.keys()


@pytest.mark.parametrize("name", [name for name, errno in NUMBERS.items() if errno in EVENTS])
def test_an_error_name_is_explained_by_its_event(name: str, tmp_path: Path) -> None:
    number = EVENTS[NUMBERS[name]]
    ended = call("explain", name.lower(), cwd=tmp_path)
    assert ended.code == 0
    assert ended.out.startswith(f"{number} {EVENT_TITLES[number]}\n")
    assert f"ERRNO={name}" in ended.out
    assert call("explain", str(number), cwd=tmp_path).out == ended.out


def test_what_cannot_be_explained_is_said(tmp_path: Path) -> None:
    assert "is not known here" in call("explain", "ERR_FILEACC", cwd=tmp_path).out
    assert "did you mean `ERR_DIVZERO`?" in call("explain", "ERR_DIVZER", cwd=tmp_path).err
    assert "no rule cites the event 12345" in call("explain", "12345", cwd=tmp_path).err


@pytest.mark.parametrize(
    ("statement", "number"),
    [("v:=1/q;", 40194), ("v:=a{4+q};", 40204), ('%"nobody"%;', 40168), ("RAISE 7;", 40229)],
)
def test_an_error_that_ends_a_run_has_its_own_event(
    statement: str, number: int, tmp_path: Path
) -> None:
    text = MODULE.replace("@declared", "").replace("@", statement).replace("q:=1", "q:=0")
    (tmp_path / "m.mod").write_text(text)
    ended = call("run", "m.mod", "--no-record", cwd=tmp_path)
    assert ended.code == 1
    assert f"(cf. ABB {number})" in " ".join(ended.out.split())
