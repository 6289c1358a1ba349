"""Write `docs/api.md` from the docstrings of the package: `python scripts/build_api_page.py`."""

from __future__ import annotations

import dataclasses
import html
import inspect
import re
import textwrap
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from wrap_markdown import wrap

import rapidsim
from rapidsim.api.moves import MoveArrays, Moves
from rapidsim.api.views import ArmMotion, ArmState, Datum, Edge, SignalHistory
from rapidsim.diagnostics import Diagnostic
from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.run.records import MoveRecord, WaitRecord

PAGE = Path(__file__).parents[1] / "docs" / "api.md"
INTRODUCTION = """\
# Python API

Every public name, generated from the docstrings by `python scripts/build_api_page.py`. Examples,
all of them executed, are in [Use it from Python](python.md). Lengths are mm, angles degrees, times
seconds where a name ends in `_mm`, `_deg` or `_s`; robots and transforms are in m and rad.
"""
NAMES = (
    "load",
    "Cell",
    "Run",
    "CheckResult",
    "check",
    "simulate",
    "record",
    "parse",
    "json_schema",
    "load_robot",
    "InputError",
    "RobotError",
    "ProgramRejectedError",
    "CallError",
)
"""In the order in which one meets them; together with the version, all of `rapidsim.__all__`."""
RETURNED = (
    Diagnostic,
    Moves,
    MoveArrays,
    MoveRecord,
    WaitRecord,
    SignalHistory,
    Edge,
    ArmMotion,
    ArmState,
    Datum,
    Robot,
    Transform,
)
"""What these give: classes that nobody imports by name."""
LONGEST_LINE = 90
WRITTEN = {
    r"\bPath(Like)?_": "str | PathLike[str]",
    r"\bRounded\b": "float",
    r"^Annotated\[(\w+), .*\]$": r"\1",
    r"^OrAbsent\[(.*)\]$": r"\1 | None",
}
"""Types for readers by pattern: marks of JSON records (`rapidsim/json_records/`) are omitted."""
SECTION = re.compile(r"^(Args|Returns|Raises|Yields):$", re.MULTILINE)


def page() -> str:
    """The page: functions and classes of the package, then what they return."""
    parts = [INTRODUCTION]
    for name in NAMES:
        parts += _entry(f"rapidsim.{name}", getattr(rapidsim, name), "##")
    parts.append("\n## What these return\n")
    for one in RETURNED:
        parts += _entry(one.__name__, one, "###")
    return wrap("\n".join(parts) + "\n")


def _entry(name: str, thing: object, level: str) -> Iterator[str]:
    yield f"\n{level} {name.removeprefix('rapidsim.')}\n"
    if inspect.isclass(thing):
        yield _docstring(thing)
        yield from _attributes(thing)
        yield from _methods(thing, level + "#")
    else:
        assert callable(thing)
        yield f"```text\n{_signature(name, thing)}\n```\n"
        yield _docstring(thing)


def _signature(name: str, function: object) -> str:
    """As one would write it, an argument a line where it is long."""
    assert callable(function)
    signature = inspect.signature(function)
    written: list[str] = []
    for one in signature.parameters.values():
        starred = any(text.startswith("*") for text in written)
        if one.kind is one.KEYWORD_ONLY and not starred:
            written.append("*")
        if one.name != "self":
            written.append(_parameter(one))
    returned = _type(signature.return_annotation)
    text = f"{name}({', '.join(written)}) -> {returned}"
    if len(text) <= LONGEST_LINE:
        return text
    return "\n".join([f"{name}(", *(f"    {one}," for one in written), f") -> {returned}"])


def _parameter(one: inspect.Parameter) -> str:
    stars = {one.VAR_POSITIONAL: "*", one.VAR_KEYWORD: "**"}.get(one.kind, "")
    default = "" if one.default is one.empty else f" = {one.default!r}"
    return f"{stars}{one.name}: {_type(one.annotation)}{default}"


def _type(annotation: object) -> str:
    text = str(getattr(annotation, "__forward_arg__", annotation))
    for pattern, replacement in WRITTEN.items():
        text = re.sub(pattern, replacement, text)
    return text


def _attributes(owner: type) -> Iterator[str]:
    """Fields and properties, with what is written below or in them."""
    rows = [*_fields(owner), *_properties(owner)]
    if rows:
        yield "| attribute | type | |\n|---|---|---|"
        for name, kind, text in rows:
            shown = f"<code>{html.escape(kind).replace('|', '&#124;')}</code>"
            yield f"| `{name}` | {shown} | {_one_line(text)} |"
        yield ""


def _fields(owner: type) -> Iterator[tuple[str, str, str]]:
    if not (dataclasses.is_dataclass(owner) or hasattr(owner, "_fields")):
        return
    source = inspect.getsource(owner)
    for name, kind in owner.__annotations__.items():
        if not name.startswith("_"):
            pattern = rf'^    {name}: [^\n]*\n(?:    """(.*?)""")?'
            found = re.search(pattern, source, re.MULTILINE | re.DOTALL)
            yield name, _type(kind), textwrap.dedent((found and found[1]) or "")


def _properties(owner: type) -> Iterator[tuple[str, str, str]]:
    for name, member in vars(owner).items():
        if not name.startswith("_") and isinstance(member, property | cached_property):
            function = member.fget if isinstance(member, property) else member.func
            assert function is not None
            kind = _type(inspect.signature(function).return_annotation)
            yield name, kind, inspect.getdoc(function) or ""


def _methods(owner: type, level: str) -> Iterator[str]:
    for name, member in vars(owner).items():
        if name.startswith("_"):
            continue
        function = member.__func__ if isinstance(member, classmethod | staticmethod) else member
        if inspect.isfunction(function):
            yield f"{level} {owner.__name__}.{name}\n"
            yield f"```text\n{_signature(name, function)}\n```\n"
            yield _docstring(function)


def _docstring(thing: object) -> str:
    """Markdown of a docstring with Google's sections."""
    text = inspect.getdoc(thing) or ""
    first, *sections = SECTION.split(text)
    parts = [first.strip(), ""]
    for title, body in zip(sections[::2], sections[1::2], strict=True):
        parts += [f"**{title.replace('Args', 'Arguments')}**", ""]
        parts += _items(textwrap.dedent(body.strip("\n"))) if title != "Returns" else [_flow(body)]
        parts.append("")
    return "\n".join(parts)


def _items(body: str) -> Iterator[str]:
    for item in re.split(r"\n(?=\S)", body.strip()):
        name, _, text = item.partition(":")
        yield f"- `{name}`: {_flow(text)}"


def _flow(text: str) -> str:
    return " ".join(text.split())


def _one_line(text: str) -> str:
    """A docstring in a cell of a table."""
    return _flow(SECTION.sub(r"**\1**:", text)).replace("|", "\\|")


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
