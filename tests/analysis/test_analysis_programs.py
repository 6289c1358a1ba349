"""Programs whose comments say what must be found: `! error: N201`, `! warning: N209, I801`.

A line without such a comment must have no finding at all. Files in a folder are modules of one
task.
"""

import re
from collections import Counter
from pathlib import Path

import pytest

from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Severity, Source
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
