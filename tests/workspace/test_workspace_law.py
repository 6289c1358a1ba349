"""The law of a workspace: its findings are those of a new check, whatever was edited before."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

import pytest
from declaration_edits import declaration_edit
from fresh_check import (
    contents,
    fresh_findings,
    modules,
    opened,
    text_of,
)

from rapidsim.workspace.changes import TextChange, changed_text

_WORD = re.compile(r"[A-Za-z_]\w*")
_EDITS = 12
_FILES = [
    one
    for one in modules("programs", "tests/analysis", "tests/rapid", "tests/check")
    if 300 < one.stat().st_size < 8000
]


def random_edit(rng: random.Random, text: str) -> TextChange:
    """A character typed or removed, a line doubled or removed, a word replaced by a neighbour."""
    at = rng.randrange(len(text))
    line = text.rfind("\n", 0, at) + 1
    behind = text.find("\n", at) + 1 or len(text)
    words = list(_WORD.finditer(text, max(0, at - 200), at + 200))
    match rng.randrange(5):
        case 0:
            return TextChange(at, at, rng.choice([" ", "1", "x", ";", "\n", '"', "("]))
        case 1:
            return TextChange(at, min(len(text), at + rng.randint(1, 3)), "")
        case 2:
            return TextChange(line, line, text[line:behind])
        case 3 if words:
            word = rng.choice(words)
            return TextChange(word.start(), word.end(), rng.choice(words).group())
        case _:
            return TextChange(line, behind, "")


def edited(path: str, text: str, rng: random.Random) -> Iterator[str]:
    """Open a text, edit it, and yield it after each edit that a new check agrees with."""
    cell = opened({path: text})
    for _ in range(_EDITS):
        change = random_edit(rng, text)
        before, text = text, changed_text(text, [change])
        cell.change(path, [change])
        yield text
        assert [contents(one) for one in cell.findings(path)] == fresh_findings({path: text})[path]
        if rng.random() < 0.5:
            start, end = change.start, change.start + len(change.text)
            cell.change(path, [TextChange(start, end, before[change.start : change.end])])
            text = before


@pytest.mark.parametrize("number", range(12))
def test_findings_are_those_of_a_new_check(number: int) -> None:
    rng = random.Random(number)
    file = rng.choice(_FILES)
    for text in edited(file.name, text_of(file), rng):
        assert isinstance(text, str)


def test_edits_of_several_files_of_a_task() -> None:
    rng = random.Random(1)
    texts = {file.name: text_of(file) for file in modules("programs/cell")}
    cell = opened(texts)
    for _ in range(_EDITS):
        path = rng.choice(sorted(texts))
        change = random_edit(rng, texts[path])
        texts[path] = changed_text(texts[path], [change])
        cell.change(path, [change])
        fresh = fresh_findings(texts)
        assert {one: [contents(f) for f in cell.findings(one)] for one in texts} == fresh


@pytest.mark.parametrize("number", range(16))
def test_edits_of_declarations(number: int) -> None:
    rng = random.Random(number)
    files = modules("programs/cell") if number % 4 == 0 else [rng.choice(_FILES)]
    texts = {file.name: text_of(file) for file in files}
    cell = opened(texts)
    for _ in range(_EDITS):
        path = rng.choice(sorted(texts))
        before = texts[path]
        change = declaration_edit(rng, before)
        if change is None:
            continue
        texts[path] = changed_text(before, [change])
        cell.change(path, [change])
        fresh = fresh_findings(texts)
        assert {one: [contents(f) for f in cell.findings(one)] for one in texts} == fresh
        if rng.random() < 0.5:
            start, end = change.start, change.start + len(change.text)
            cell.change(path, [TextChange(start, end, before[change.start : change.end])])
            texts[path] = before


BODY = "MODULE m\n{}  PROC main()\n{}  ENDPROC\n{}ENDMODULE\n"


@pytest.mark.parametrize(
    ("text", "old", "new"),
    [
        pytest.param(
            BODY.format("", "    a;\n", "  PROC b()\n    IF TRUE THEN\n  ENDPROC\n"),
            "    a;\n",
            "    a;\n\n",
            id="the line that an error names moves",
        ),
        pytest.param(
            BODY.format("", "    SetDO x,1;\n", "  PROC b()\n    IF x=1 x:=2;\n  ENDPROC\n"),
            "SetDO x",
            "SetDO y",
            id="a signal is one no longer",
        ),
        pytest.param(
            BODY.format("", "    a;\n", "  PROC b()\n    c;\n  ENDPROC\n"),
            "    a;\n",
            "    VAR c ] [ ;\n",
            id="a name may be declared in text that cannot be read",
        ),
        pytest.param(
            BODY.format("", "    b;\n", "  PROC b()\n    WHILE TRUE DO\n    ENDWHILE\n  ENDPROC\n"),
            "    ENDWHILE",
            "      RETURN;\n    ENDWHILE",
            id="a callee returns after all",
        ),
        pytest.param(
            BODY.format("", "    ActUnit u;\n", "  PROC b()\n    ActUnit u;\n  ENDPROC\n"),
            "    ActUnit u;\n  ENDPROC\n  PROC",
            "  ENDPROC\n  PROC",
            id="the first use of a unit goes",
        ),
        pytest.param(
            BODY.format("", "    ! rapidsim: ignore[N209]\n    a;\n", ""),
            "    ! rapidsim: ignore[N209]\n",
            "    ! rapidsim: ignore[N209]\n    b;\n",
            id="a suppression is of another line",
        ),
        pytest.param(
            BODY.format("", "    x := 1;\n", "")[: -len("ENDMODULE\n")],
            "x := 1",
            "x := 12",
            id="the module has no end",
        ),
        pytest.param(
            BODY.format("", "    a;\r", "").replace("\n", "\r"),
            "    a;\r",
            "    a\r    b;\n",
            id="the file had another line end",
        ),
        pytest.param(
            BODY.format("", "    x := 1;\n", "")[: -len("ENDMODULE\n")].replace("\n", "\r\n"),
            "x := 1",
            "x := 12",
            id="a fix adds a line with the line end of the file",
        ),
        pytest.param(
            BODY.format("", "", "  FUNC num f()\n    RETURN 1;\n")[:-10]
            + "  FUNC num g()\n  ENDFUNC ! note\nENDMODULE\n",
            "RETURN 1",
            "RETURN 2",
            id="a fix adds a line behind a comment",
        ),
        pytest.param(
            BODY.format("", "    VAR other x;\n    x:=[1,2];\n", "  VAR other y;\n"),
            "x:=[1,2]",
            "x:=[1]",
            id="data of an undeclared type",
        ),
    ],
)
def test_what_one_routine_means_to_another(text: str, old: str, new: str) -> None:
    at = text.index(old)
    cell = opened({"m.mod": text})
    for change in (TextChange(at, at + len(old), new), TextChange(at, at + len(new), old)):
        text = changed_text(text, [change])
        cell.change("m.mod", [change])
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh


def test_a_routine_outgrows_its_room() -> None:
    text = BODY.format("", "    a;\n", "")
    cell = opened({"m.mod": text})
    line = "    a;\n" * 50
    ways = []
    for _ in range(4):
        at = text.index("  ENDPROC")
        text = changed_text(text, [TextChange(at, at, line)])
        ways.append(cell.change("m.mod", [TextChange(at, at, line)]).is_local)
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh
    assert set(ways) == {True, False}


def test_typing_in_a_body_reads_one_routine() -> None:
    text = BODY.format("  VAR num n;\n", "", "  PROC b()\n    n:=1;\n  ENDPROC\n")
    at = text.index("  ENDPROC")
    cell = opened({"m.mod": text})
    ways = []
    for character in "    IF n=1 THEN\n      b;\n    ENDIF\n":
        change = TextChange(at, at, character)
        ways.append(cell.change("m.mod", [change]).is_local)
        text, at = changed_text(text, [change]), at + 1
    assert all(ways)
    fresh = fresh_findings({"m.mod": text})["m.mod"]
    assert [contents(one) for one in cell.findings("m.mod")] == fresh


DECLARATIONS = """MODULE m
  CONST num first:=1;
  CONST num second:=first+1;

  PROC main()
    VAR num n;
    n:=second+added;
    helper n;
    IF n>third THEN
      stop;
    ENDIF
  ENDPROC

  PROC helper(num count)
    TPWrite "main"\\Num:=count;
  ENDPROC

  PROC other()
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param("  CONST num first", "  VAR num added;\n  CONST num first", id="before"),
        pytest.param("\n\n  PROC main", "\n  VAR num third:=3;\n\n  PROC main", id="behind"),
        pytest.param("  CONST num second:=first+1;", "", id="removed"),
        pytest.param("num second", "num secind", id="renamed"),
        pytest.param("CONST num first", "CONST bool first", id="another type"),
        pytest.param("CONST num first", "LOCAL CONST num first", id="another scope"),
        pytest.param("helper(num count)", "helpers(num count)", id="renamed routine"),
        pytest.param("helper(num count)", "helper(num count,num more)", id="a parameter more"),
        pytest.param("PROC helper", "LOCAL PROC helper", id="a routine of the module"),
        pytest.param("  PROC helper", "  PROC stop()\n  ENDPROC\n\n  PROC helper", id="a routine"),
        pytest.param("PROC other", "PROC helper", id="two routines of one name"),
        pytest.param("    ENDIF\n", "", id="an open block"),
    ],
)
def test_an_edit_of_a_declaration_checks_what_names_it(old: str, new: str) -> None:
    text = DECLARATIONS
    at = text.index(old)
    cell = opened({"m.mod": text})
    while old and new and old[0] == new[0]:
        at, old, new = at + 1, old[1:], new[1:]
    while old and new and old[-1] == new[-1]:
        old, new = old[:-1], new[:-1]
    for change in (TextChange(at, at + len(old), new), TextChange(at, at + len(new), old)):
        text = changed_text(text, [change])
        assert cell.change("m.mod", [change]).is_local
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh


OWN_TYPES = """MODULE m
  RECORD size
    num width;
  ENDRECORD
  LOCAL ALIAS num grade;
  CONST size first:=[1];
  CONST grade second:=2;

  PROC main()
    TPWrite ""\\Num:=first.width;
    TPWrite ""\\Num:=second;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(("old", "new"), [("[1]", "[1,2]"), ("=2;", "=TRUE;")])
def test_data_of_types_of_the_task_are_checked_with_what_names_them(old: str, new: str) -> None:
    text, at = OWN_TYPES, OWN_TYPES.index(old)
    cell = opened({"m.mod": text})
    for change in (TextChange(at, at + len(old), new), TextChange(at, at + len(new), old)):
        text = changed_text(text, [change])
        assert cell.change("m.mod", [change]).is_local
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh


@pytest.mark.parametrize(
    "typed",
    [
        "  VAR num added:=[1,2];\n",
        "  PROC typed(num x)\n  ENDPROC\n",
        '  CONST string note:="a b"; ! why\n',
    ],
)
def test_typing_a_declaration_reads_its_neighbours(typed: str) -> None:
    text = DECLARATIONS
    at = text.index("\n  PROC helper") + 1
    cell = opened({"m.mod": text})
    for character in typed:
        change = TextChange(at, at, character)
        text, at = changed_text(text, [change]), at + 1
        assert cell.change("m.mod", [change]).is_local
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh


def test_an_empty_module_is_typed_by_part() -> None:
    text = "MODULE m\n\nENDMODULE\n"
    cell = opened({"m.mod": text})
    at = text.index("\n") + 1
    ways = []
    for character in "  VAR num first;\n  PROC main()\n    first:=1;\n  ENDPROC\n":
        change = TextChange(at, at, character)
        text, at = changed_text(text, [change]), at + 1
        ways.append(cell.change("m.mod", [change]).is_local)
        fresh = fresh_findings({"m.mod": text})["m.mod"]
        assert [contents(one) for one in cell.findings("m.mod")] == fresh
    assert ways.count(False) < 3


def test_blank_lines_in_a_quoted_expression_change_nothing() -> None:
    text = "MODULE m\n  VAR num a{1=[2,\n    3]};\nENDMODULE\n"
    cell = opened({"m.mod": text})
    change = TextChange(text.index("    3"), text.index("    3"), "\n\n")
    cell.change("m.mod", [change])
    found = [contents(one) for one in cell.findings("m.mod")]
    assert found == fresh_findings({"m.mod": changed_text(text, [change])})["m.mod"]
    assert "`1=[2, 3]`" in str(found)
