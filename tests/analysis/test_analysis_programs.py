"""Programs whose comments say what must be found: `! error: N201`, `! warning: N209, I801`.

A line without such a comment must have no finding at all. Files in a folder are modules of one
task.
"""

import re
from collections import Counter
from pathlib import Path

import pytest

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Severity, Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse

FOLDER = Path(__file__).parent / "programs"
TASKS = sorted(path for path in FOLDER.iterdir() if path.suffix == ".mod" or path.is_dir())
EXPECTED = re.compile(r"! (error|warning|note): ([A-Z]\d+(?:, [A-Z]\d+)*)")

Finding = tuple[str, int, str, str]
"""File, line, severity, code."""


def sources(task: Path) -> list[Source]:
    paths = sorted(task.iterdir()) if task.is_dir() else [task]
    return [Source(path.name, path.read_text(encoding="utf-8")) for path in paths]


def expected(source: Source) -> Counter[Finding]:
    return Counter(
        (source.file, number, match.group(1), code)
        for number in range(1, len(source.line_starts) + 1)
        for match in EXPECTED.finditer(source.line(number))
        for code in match.group(2).split(", ")
    )


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.stem)
def test_finds_what_the_comments_say(task: Path) -> None:
    texts = sources(task)
    parsed = [parse(source) for source in texts]
    assert not [found for one in parsed for found in one.diagnostics]
    checked = check([one.file for one in parsed])
    found: Counter[Finding] = Counter()
    for one in checked.diagnostics:
        assert one.span is not None
        place = (one.span.file, one.span.line)
        found[(*place, one.severity.value, one.violation.code)] += 1
    wanted = sum((expected(source) for source in texts), Counter[Finding]())
    messages = [
        f"{one.span.line}: {one.violation.message}" for one in checked.diagnostics if one.span
    ]
    assert not sorted((wanted - found).elements()), messages
    assert not sorted((found - wanted).elements()), messages
    is_wrong = any(one.severity is Severity.ERROR for one in checked.diagnostics)
    assert (checked.program is None) == is_wrong


def test_a_function_that_nobody_knows_returns_what_stands_beside_it() -> None:
    text = """MODULE m
VAR num n; VAR dnum d; VAR string s; VAR bool b; VAR pos p;
PROC main()
d:=d+f1(1); d:=f2(1)+d; s:=s+f3(2); n:=f4(1)+f5(2); b:=f6(1) AND b; b:=f7(1)=s; b:=n>f8(2);
p:=p+f9(3); b:=NOT f10(2); d:=f11(2); TPWrite f12();
ENDPROC
ENDMODULE
"""
    checked = check([parse(Source("m.mod", text)).file], cell=CellNames(assumes=True))
    assert checked.program is not None
    calls = {one for one in checked.program.symbol_of if isinstance(one, tree.FunctionCall)}
    types = {one.name.text: checked.program.type_of[one].name for one in calls}
    assert [f"{name} {types[name]}" for name in sorted(types, key=lambda name: int(name[1:]))] == [
        *("f1 dnum", "f2 dnum", "f3 string", "f4 num", "f5 num", "f6 bool", "f7 string", "f8 num"),
        *("f9 pos", "f10 num", "f11 dnum", "f12 string"),
    ]
