"""All installed routines as pages of Markdown: `docs/library.md` lists their chapters."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping

from rapidsim.language.annotations import ParameterMode
from rapidsim.library.catalogue import CHAPTERS, ROUTINES
from rapidsim.library.declared import read_declared_chapters
from rapidsim.library.table import LibraryRoutine, Parameter
from rapidsim.library.versions import SINCE

_INTRODUCTION = """\
# Library

The instructions and functions that RAPID predefines: {known} are known, so that a program that
calls them is checked, and {simulated} of them are simulated. For the others, each entry states what
a run does instead; the run reports it, too. Made from the source by
`python scripts/build_library_page.py`.

Additions of RobotWare 7 are marked. What RobotWare 7 has dropped is not listed: with
`robotware = "7.13"` a station may still use everything that RobotWare 6 has.

`\\Name` is an optional argument, `|` divides arguments of which at most one may be given.
"""


def library_pages() -> Mapping[str, str]:
    """Return the pages by path below `docs`: chapters with counts, then a page for each."""
    chapters = _chapters()
    simulated = sum(row.simulated for row in ROUTINES.values())
    parts = [_INTRODUCTION.format(known=len(ROUTINES), simulated=simulated)]
    lines = ["| chapter | routines | simulated |", "|---|---|---|"]
    for title, rows in chapters.items():
        count = sum(row.simulated for row in rows)
        lines.append(f"| [{title}]({_path(title)}) | {len(rows)} | {count} |")
    parts.append("\n".join(lines) + "\n")
    pages = {"library.md": "\n".join(parts)}
    for title, rows in chapters.items():
        entries = [_entry(row) for row in sorted(rows, key=lambda row: row.name.lower())]
        body = "\n".join(entries)
        pages[_path(title)] = f"# {title}\n\n{body}\n\n[All chapters](../library.md)\n"
    return pages


def signature_text(row: LibraryRoutine) -> str:
    r"""The head of a routine as RAPID writes it: `PROC SetDO(\num SDelay | switch Sync, ...)`."""
    signature = row.signature
    kind = "PROC" if signature.result is None else f"FUNC {signature.result.name}"
    text = "..." if signature.is_open else ""
    group = 0
    for parameter in signature.parameters:
        if not parameter.optional:
            text += f", {_parameter(parameter)}" if text else _parameter(parameter)
        elif parameter.group and parameter.group == group:
            text += f" | {_parameter(parameter)}"
        else:
            text += f"{' ' if text else ''}\\{_parameter(parameter)}"
        group = parameter.group
    return f"{kind} {row.name}({text})"


def _chapters() -> Mapping[str, list[LibraryRoutine]]:
    chapters = {title: list(rows.values()) for title, rows in CHAPTERS.items()}
    for title, names in read_declared_chapters().items():
        chapters.setdefault(title, []).extend(ROUTINES[name] for name in names)
    return chapters


def _entry(row: LibraryRoutine) -> str:
    return f"- `{signature_text(row)}`  \n  {'. '.join(_how(row))}."


def _how(row: LibraryRoutine) -> Iterator[str]:
    first = (inspect.getdoc(row.function) or "").partition("\n")[0].strip().rstrip(".")
    if first:
        yield first
    if row.treated_as is not None:
        yield f"*Not simulated: {row.treated_as}*"
    elif not first:
        yield "Executed by the interpreter"
    for name, key in _versioned(row):
        if key in SINCE:
            since = SINCE[key]
            yield f"{name} since RobotWare {since if since.minor else since.major}"


def _versioned(row: LibraryRoutine) -> Iterator[tuple[str, str]]:
    """The routine and its parameters, each with its key in the table of versions."""
    yield "Known", row.name.lower()
    for parameter in row.signature.parameters:
        option = f"\\{parameter.name}"
        yield f"`{option}`", f"{row.name}{option}".lower()


def _parameter(parameter: Parameter) -> str:
    of = " or ".join(one.name for one in parameter.types)
    mode = "" if parameter.mode is ParameterMode.IN else f"{parameter.mode.value} "
    return f"{mode}{of} {parameter.name}"


def _path(title: str) -> str:
    """The path of a chapter's page below `docs`."""
    words = "".join(letter if letter.isalnum() else " " for letter in title.lower()).split()
    return f"library/{'-'.join(words)}.md"
