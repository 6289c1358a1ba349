"""The language book: small programs whose comments say what must happen, and nothing else may."""

import re
from pathlib import Path

import pytest
from rapid_promises import happened, happened_in_cell, promised, sources

from rapidsim.station.station import FILE_NAME

BOOK = Path(__file__).parent
CHAPTERS = (
    "lexical",
    "declarations",
    "types",
    "expressions",
    "statements",
    "routines",
    "parameters",
    "errors",
    "answers",
    "interrupts",
    "waiting",
    "motion",
    "recovery",
    "configurations",
    "modules",
    "operator",
    "system",
    "messages",
    "newer",
    "oddities",
    "broken",
)
PROGRAMS = [program for chapter in CHAPTERS for program in sorted((BOOK / chapter).iterdir())]
TITLE = re.compile(
    r"^\s*! (RAPID (Kernel|Overview|Instructions|Functions|Data types)|Field practice), \w"
)


def name(program: Path) -> str:
    return f"{program.parent.name}/{program.stem}"


@pytest.mark.parametrize("program", PROGRAMS, ids=name)
def test_what_a_program_promises_is_what_happens(program: Path) -> None:
    texts = sources(program)
    if (program / FILE_NAME).exists():
        assert happened_in_cell(program) == promised(texts)
        return
    home = program / "home"
    assert happened(texts, home if home.is_dir() else None) == promised(texts)


def test_every_program_names_its_rule_and_where_the_rule_is_from() -> None:
    heads = {source.file: source.text.splitlines()[:6] for p in PROGRAMS for source in sources(p)}
    assert not [file for file, head in heads.items() if not any(map(TITLE.match, head))]


@pytest.mark.parametrize("program", sorted((BOOK / "broken").iterdir()), ids=name)
def test_a_broken_shape_gives_one_finding_in_its_place(program: Path) -> None:
    found = [fact for fact in happened(sources(program)) if fact[2] in ("error", "warning")]
    assert len(found) == 1
    assert found[0][1] > 0
