"""One mistake in each of forty programs is found where it is, and forty odd but right ones pass.

Both kinds share their declarations (`common.mod`) and stand in files of their own, parted by lines
`! ---`; a mistake is marked with the code that finds it.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from check_helper import HERE, found_in, lines

PROGRAMS = HERE / "mistakes"
MARK = re.compile(r"! ([A-Z]\d{3})$", re.MULTILINE)
UNUSED = ("N204", "N205")
"""Not every program uses all that they share."""


def programs(file: str) -> list[str]:
    common = (PROGRAMS / "common.mod").read_text("utf-8")
    parts = (PROGRAMS / file).read_text("utf-8").split("! ---\n")
    return [f"MODULE planted\n{common}{part}ENDMODULE\n" for part in parts]


MISTAKES, ODDITIES = programs("mistakes.mod"), programs("oddities.mod")


def test_there_are_forty_of_each() -> None:
    assert len(MISTAKES) >= 40
    assert len(ODDITIES) >= 40


@pytest.mark.parametrize("text", MISTAKES, ids=range(len(MISTAKES)))
def test_a_mistake_is_found_at_its_line_with_a_cure(text: str, tmp_path: Path) -> None:
    (code,) = MARK.findall(text)
    line = text[: text.index(f"! {code}\n")].count("\n") + 1
    file = tmp_path / "planted.mod"
    file.write_text(text, encoding="utf-8")
    found = [one for one in found_in(file) if one.violation.code == code]
    assert [one.span.line for one in found if one.span] == [line], lines(found_in(file))
    assert all(one.violation.help for one in found)


@pytest.mark.parametrize("text", ODDITIES, ids=range(len(ODDITIES)))
def test_a_legal_oddity_is_silent(text: str, tmp_path: Path) -> None:
    file = tmp_path / "planted.mod"
    file.write_text(text, encoding="utf-8")
    found = tuple(
        one
        for one in found_in(file)
        if one.violation.rule.on_by_default and one.violation.code not in UNUSED
    )
    assert not found, lines(found)
