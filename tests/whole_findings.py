"""Findings with all that is said of them, held to a file: a section for each program.

`UPDATE_GOLDEN=1 pytest` writes the sections anew, without `-n`; read the difference before you keep
it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from rapidsim.diagnostics import Diagnostic
from rapidsim.json_records.encoding import RecordEncoder
from rapidsim.report.findings.diagnostic_records import diagnostic_record
from rapidsim.report.findings.merging import Finding

_HEAD = re.compile(r"^== (.*)\n", re.MULTILINE)


def records(found: Iterable[Diagnostic]) -> list[Mapping[str, Any]]:
    """Findings as `check` prints them in JSON, none merged."""
    return [RecordEncoder()(diagnostic_record(Finding(one))) for one in found]


def whole(found: Iterable[Mapping[str, Any]]) -> str:
    """Findings with all that JSON says of them, one after the other."""
    return "".join(f"{line}\n" for one in found for line in _lines(one))


def _lines(one: Mapping[str, Any]) -> Iterator[str]:
    inside = f" in {one['routine']}" if one["routine"] else ""
    cf = f" (cf. {one['cf']})" if one["cf"] else ""
    yield f"{one['code']} {one['severity']} {_place(one)}{inside}: {one['message']}{cf}"
    if one["help"]:
        yield f"  help: {one['help']}"
    for related in one["related"]:
        yield f"  {related['line']}: {related['message']}"
    if one["fix"]:
        yield f"  {'' if one['fix']['safe'] else 'unsafe '}fix: {one['fix']['title']}"
        for edit in one["fix"]["edits"]:
            yield f"    {_place(edit)} {edit['text']!r}"


def _place(of: Mapping[str, Any]) -> str:
    line, end_line = of["line"], of["end_line"]
    last = f"{end_line}:{of['end_column']}" if line != end_line else of["end_column"]
    return "everywhere" if line is None else f"{line}:{of['column']}-{last}"


def assert_section(file: Path, name: str, text: str) -> None:
    """Compare a text with a section of a file; see the head of this module."""
    if os.environ.get("UPDATE_GOLDEN"):
        found = dict(sections(file)) | {name: text}
        sections.cache_clear()
        file.parent.mkdir(exist_ok=True)
        texts = (f"== {one}\n{found[one]}" for one in sorted(found))
        file.write_text("".join(texts), encoding="utf-8")
    assert text == sections(file)[name]


@cache
def sections(file: Path) -> Mapping[str, str]:
    """The texts of a file, by the name in the line `== name` above each."""
    if not file.is_file():
        return {}
    _, *parts = _HEAD.split(file.read_text(encoding="utf-8"))
    return dict(zip(parts[::2], parts[1::2], strict=True))
