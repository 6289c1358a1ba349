"""Changes between two programs: data, routines and statements, matched by name.

Layout, comments, the order of routines and moves between files are not changes. An item that has
another name, but is otherwise equal, is renamed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from difflib import SequenceMatcher
from typing import TypeVar

from rapidsim.analysis.literals import literal
from rapidsim.applications.diff.changes import ComponentChange, ProgramChange
from rapidsim.applications.diff.components import changed_components
from rapidsim.applications.diff.program_parts import (
    Declaration,
    NormalisedLine,
    ProgramParts,
    Routine,
    folded,
)
from rapidsim.applications.diff.values import difference, kind_of
from rapidsim.applications.diff.world import object_in_world, target_in_world
from rapidsim.library.catalogue import ROUTINES
from rapidsim.syntax import tree
from rapidsim.syntax.printer import print_expression

T = TypeVar("T", Declaration, Routine)

_ARGUMENT_KINDS = {
    "topoint": "target",
    "tojointpos": "target",
    "cirpoint": "target",
    "speed": "speed",
    "zone": "zone",
    "tool": "tool",
    "wobj": "work object",
    "signal": "signal",
}
_WORD = re.compile(r"\w+")


def program_changes(old: ProgramParts, new: ProgramParts) -> tuple[ProgramChange, ...]:
    """Return all changes: for each kind, new items, then removed ones."""
    renamed = _renamed(old, new)
    return (
        *_module_changes(old, new),
        *_type_changes(old, new),
        *_data_changes(old, new, renamed),
        *_routine_changes(old, new, renamed),
    )


def _renamed(old: ProgramParts, new: ProgramParts) -> dict[str, str]:
    """Return the new folded names of routines and data by old ones."""
    found: dict[str, str] = {}
    for _ in range(2):
        # A routine may differ by the name of data only, and vice versa.
        for before, after in _pairs(old.routines, new.routines, lambda one: _body(one, found)):
            found[before] = after
        for before, after in _pairs(old.data, new.data, lambda one: _value(one, found)):
            if _is_used_as(before, after, old, new, found):
                found[before] = after
    return found


def _pairs(
    old: Mapping[str, T], new: Mapping[str, T], content: Callable[[T], str]
) -> Iterator[tuple[str, str]]:
    """Yield pairs of names of removed and new items with equal content, if unambiguous."""
    gone = {key: content(one) for key, one in old.items() if key not in new}
    come = {key: content(one) for key, one in new.items() if key not in old}
    for before, text in gone.items():
        same = [key for key, other in come.items() if other == text]
        if len(same) == 1 and list(gone.values()).count(text) == 1:
            yield before.rpartition("/")[2], same[0].rpartition("/")[2]


def _body(routine: Routine, renamed: Mapping[str, str]) -> str:
    own = {routine.name.lower(): "*", **renamed}
    return "\n".join(folded(line.text, own) for line in routine.lines)


def _value(data: Declaration, renamed: Mapping[str, str]) -> str:
    return folded(f"{data.storage} {data.type} {data.text}", renamed)


def _is_used_as(
    before: str, after: str, old: ProgramParts, new: ProgramParts, renamed: Mapping[str, str]
) -> bool:
    """Whether a line that uses the old data exists with the new name."""
    named = {**renamed, before: after}
    lines = {
        folded(line.text, named)
        for routine in old.routines.values()
        for line in routine.lines
        if before in _WORD.findall(line.folded)
    }
    return any(folded(line.text) in lines for one in new.routines.values() for line in one.lines)


def _module_changes(old: ProgramParts, new: ProgramParts) -> Iterator[ProgramChange]:
    for key, (attributes, at) in new.modules.items():
        if key in old.modules and old.modules[key][0] != attributes:
            text = f"attributes {old.modules[key][0] or 'none'} -> {attributes or 'none'}"
            yield ProgramChange("module", key, text, old=old.modules[key][1], new=at)


def _type_changes(old: ProgramParts, new: ProgramParts) -> Iterator[ProgramChange]:
    for key, one in new.types.items():
        before = old.types.get(key)
        if before is None:
            yield ProgramChange("type", one.name, "added", new=one.at)
        elif before.folded != one.folded:
            yield ProgramChange("type", one.name, "changed", old=before.at, new=one.at)
    for key, one in old.types.items():
        if key not in new.types:
            yield ProgramChange("type", one.name, "removed", old=one.at)


def _data_changes(
    old: ProgramParts, new: ProgramParts, renamed: Mapping[str, str]
) -> Iterator[ProgramChange]:
    names_after = {after: before for before, after in renamed.items()}
    for key, one in new.data.items():
        kind = kind_of(one.type)
        before = old.data.get(key)
        if before is None and (was := names_after.get(key.rpartition("/")[2])) is not None:
            before = _named(old.data, was)
            if before is not None:
                text = f"renamed from `{before.name}`"
                yield ProgramChange(kind, one.name, text, old=before.at, new=one.at)
            continue
        if before is None:
            values = (ComponentChange("", None, one.text),)
            yield ProgramChange(kind, one.name, f"added: {one.type}", new=one.at, values=values)
        elif folded(before.text, renamed) != folded(one.text) or before.type != one.type:
            where = _frame_changes(before, one, _objects_of(key, new), old, new)
            text = _value_difference(before, one)
            text = f"{text}{where}"
            yield ProgramChange(
                kind, one.name, text, None, before.at, one.at, _components(before, one)
            )
        elif before.folded != one.folded and folded(before.folded, renamed) != one.folded:
            text = f"{before.storage} {before.type} -> {one.storage} {one.type}"
            if before.storage == one.storage:
                text = "declared otherwise: its scope or its dimensions"
            yield ProgramChange(kind, one.name, text, old=before.at, new=one.at)
    for key, one in old.data.items():
        if key not in new.data and key.rpartition("/")[2] not in renamed:
            values = (ComponentChange("", one.text, None),)
            text = f"removed: {one.type}"
            yield ProgramChange(kind_of(one.type), one.name, text, old=one.at, values=values)


def _components(old: Declaration, new: Declaration) -> tuple[ComponentChange, ...]:
    if old.type == new.type and old.value is not None and new.value is not None:
        return changed_components(new.type, old.value, new.value)
    return (ComponentChange("", old.text, new.text),)


def _value_difference(old: Declaration, new: Declaration) -> str:
    if old.type == new.type:
        told = difference(new.type, old.value, new.value)
        if told is not None:
            return told
    return f"{old.text} -> {new.text}" if old.type == new.type else f"{old.type} -> {new.type}"


def _frame_changes(
    before: Declaration,
    after: Declaration,
    objects: Sequence[str],
    old: ProgramParts,
    new: ProgramParts,
) -> str:
    """Return the frames in which data have changed, with the change in the world."""
    values = before.value, after.value
    if kind_of(after.type) == "work object":
        return object_in_world(values)
    if kind_of(after.type) != "target" or not objects:
        return ""
    found = [_named(parts.data, objects[0].lower()) for parts in (old, new)]
    pair = tuple(one.value for one in found if one is not None)
    world = target_in_world(values, pair) if len(objects) == 1 and len(pair) == 2 else ""
    return f", in {' and '.join(objects)}{world}"


def _objects_of(key: str, parts: ProgramParts) -> Sequence[str]:
    """Return the work objects in which a target is approached, as in its moves."""
    name = key.rpartition("/")[2]
    frames: dict[str, None] = {}
    for routine in parts.routines.values():
        for line in routine.lines:
            if isinstance(line.node, tree.Call) and name in _WORD.findall(line.folded):
                given = _arguments(line.node)
                if name in _WORD.findall(folded(given.get("topoint", ""))):
                    frames[given.get("wobj", "wobj0")] = None
    return tuple(frames)


def _named(parts: Mapping[str, T], name: str) -> T | None:
    return next((one for key, one in parts.items() if key.rpartition("/")[2] == name), None)


def _routine_changes(
    old: ProgramParts, new: ProgramParts, renamed: Mapping[str, str]
) -> Iterator[ProgramChange]:
    names_after = {after: before for before, after in renamed.items()}
    for key, one in new.routines.items():
        before = old.routines.get(key)
        if before is None and (was := names_after.get(key.rpartition("/")[2])) is not None:
            before = _named(old.routines, was)
            if before is not None:
                text = f"renamed from `{before.name}`"
                yield ProgramChange("routine", one.name, text, old=before.at, new=one.at)
                continue
        if before is None:
            yield ProgramChange("routine", one.name, "added", new=one.at)
        else:
            yield from _line_changes(before, one, renamed, old, new)
    for key, one in old.routines.items():
        if key not in new.routines and key.rpartition("/")[2] not in renamed:
            yield ProgramChange("routine", one.name, "removed", old=one.at)


def _line_changes(
    before: Routine,
    after: Routine,
    renamed: Mapping[str, str],
    old: ProgramParts,
    new: ProgramParts,
) -> Iterator[ProgramChange]:
    changed, gone, come = _differing_lines(before, after, renamed)
    for line in list(come):
        twin = next((x for x in gone if folded(x.text, renamed) == folded(line.text)), None)
        if twin is not None and not _is_frame(line):
            gone.remove(twin)
            come.remove(line)
            yield _change(after, "statement", line.text, f"moved: `{line.text}`", twin, line)
    for x, y in changed:
        yield from _statement_changes(after, x, y, old, new)
    for line in come:
        if not _is_frame(line):
            yield _change(after, "statement", line.text, f"added: `{line.text}`", None, line)
    for line in gone:
        if not _is_frame(line):
            yield _change(after, "statement", line.text, f"removed: `{line.text}`", line, None)


def _differing_lines(
    before: Routine, after: Routine, renamed: Mapping[str, str]
) -> tuple[list[tuple[NormalisedLine, NormalisedLine]], list[NormalisedLine], list[NormalisedLine]]:
    """Changed statements as pairs of lines, lines that are gone, and lines that are new."""
    a = [_indented(line, renamed) for line in before.lines]
    b = [_indented(line, {}) for line in after.lines]
    gone: list[NormalisedLine] = []
    come: list[NormalisedLine] = []
    changed: list[tuple[NormalisedLine, NormalisedLine]] = []
    for word, a1, a2, b1, b2 in SequenceMatcher(None, a, b, autojunk=False).get_opcodes():
        if word == "equal":
            continue
        left, right = list(before.lines[a1:a2]), list(after.lines[b1:b2])
        pairs = list(_matching_lines(left, right))
        changed += pairs
        gone += [line for line in left if all(line is not x for x, _ in pairs)]
        come += [line for line in right if all(line is not y for _, y in pairs)]
    return changed, gone, come


def _indented(line: NormalisedLine, renamed: Mapping[str, str]) -> str:
    depth = len(line.folded) - len(line.folded.lstrip(" "))
    return " " * depth + folded(line.text, renamed)


def _is_frame(line: NormalisedLine) -> bool:
    """Whether a line only ends or divides a block that another line begins."""
    return line.text.upper() in ("ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST")


def _change(
    routine: Routine,
    kind: str,
    name: str,
    text: str,
    old: NormalisedLine | None,
    new: NormalisedLine | None,
    values: tuple[ComponentChange, ...] | None = None,
) -> ProgramChange:
    places = old.at if old else None, new.at if new else None
    if values is None:
        lines = old.text if old else None, new.text if new else None
        values = (ComponentChange("", *lines),)
    return ProgramChange(kind, name, text, routine.name, *places, values)


def _matching_lines(
    left: Sequence[NormalisedLine], right: Sequence[NormalisedLine]
) -> Iterator[tuple[NormalisedLine, NormalisedLine]]:
    """Yield pairs of lines of one statement: with the same first word, else the same arguments."""
    waiting, left_over = list(right), []
    for line in left:
        twin = next((x for x in waiting if _same_kind(x, line, _first_word)), None)
        if twin is None:
            left_over.append(line)
        else:
            yield line, twin
            waiting = waiting[waiting.index(twin) + 1 :]
    for line in left_over:
        twin = next((x for x in waiting if _same_kind(x, line, _but_first_word)), None)
        if twin is not None:
            yield line, twin
            waiting.remove(twin)


def _same_kind(a: NormalisedLine, b: NormalisedLine, part: Callable[[NormalisedLine], str]) -> bool:
    return type(a.node) is type(b.node) and part(a) == part(b)


def _but_first_word(line: NormalisedLine) -> str:
    return folded(line.text.partition(" ")[2])


def _first_word(line: NormalisedLine) -> str:
    found = _WORD.search(line.text)
    return found[0].lower() if found else line.text


def _statement_changes(
    routine: Routine, a: NormalisedLine, b: NormalisedLine, old: ProgramParts, new: ProgramParts
) -> Iterator[ProgramChange]:
    same_word = _first_word(a) == _first_word(b)
    if same_word and isinstance(a.node, tree.Call) and isinstance(b.node, tree.Call):
        before, after = _arguments(a.node), _arguments(b.node)
        told = False
        for name in dict.fromkeys((*before, *after)):
            x, y = before.get(name), after.get(name)
            if x == y or (x is not None and y is not None and folded(x) == folded(y)):
                continue
            told = True
            kind = _ARGUMENT_KINDS.get(name, "argument")
            how = _between(a.node, b.node, name, old, new)
            text = f"{b.node.name.text}: {x or 'nothing'} -> {y or 'nothing'}{how}"
            values = (ComponentChange(name, x, y),)
            yield _change(routine, kind, y or x or "", text, a, b, values)
        if told:
            return
    yield _change(routine, "statement", b.text, f"`{a.text}` -> `{b.text}`", a, b)


def _between(a: tree.Call, b: tree.Call, name: str, old: ProgramParts, new: ProgramParts) -> str:
    """Return the difference between two values of an argument, if both are known; else ""."""
    x, y = _values(a).get(name), _values(b).get(name)
    first, second = _static_value(x, old), _static_value(y, new)
    if first is None or second is None or first[0] != second[0]:
        return ""
    told = difference(first[0], first[1], second[1]) if kind_of(first[0]) != "data" else None
    return f" ({told})" if told else ""


def _static_value(
    expression: tree.Expression | None, parts: ProgramParts
) -> tuple[str, object] | None:
    """Return type and value of an argument that is a name, or a target written in place."""
    if isinstance(expression, tree.DataReference):
        found = _named(parts.data, expression.name.key)
        return None if found is None or found.value is None else (found.type, found.value)
    value = None if expression is None else literal(expression, None)
    if isinstance(value, tuple) and len(value) in (2, 4):
        return ("robtarget" if len(value) == 4 else "jointtarget"), value
    return None


def _arguments(call: tree.Call) -> dict[str, str]:
    """Arguments of a call as text, by folded parameter name, or by position if unknown."""
    texts: dict[str, str] = {}
    for name, value in _values(call).items():
        texts[name] = "TRUE" if value is None else print_expression(value)
    return texts


def _values(call: tree.Call) -> dict[str, tree.Expression | None]:
    row = ROUTINES.get(call.name.key)
    required = (
        [one.name.lower() for one in row.signature.parameters if not one.optional] if row else []
    )
    values: dict[str, tree.Expression | None] = {}
    place = 0
    for argument in call.arguments:
        match argument:
            case tree.RequiredArgument(value=value, name=name):
                known = required[place] if place < len(required) else f"argument {place + 1}"
                values[known if name is None else name.key] = value
                place += 1
            case tree.OptionalArgument(name=name, value=value):
                values[name.key] = value
            case tree.ConditionalArgument(name=name):
                values[name.key] = None
    return values
