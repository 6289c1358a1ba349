"""Template of a station file: the known facts about a cell, as TOML."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import field

from rapidsim.controller.cell.description import (
    FIRST_ROBOT,
    GROUP_WIDTH,
    SignalDeclaration,
    SignalKind,
)
from rapidsim.station.task_kind import TaskKind
from rapidsim.values import value_class

NOT_NAMED = "no arm is named: `rapidsim robots` lists those available"
_WIDTH = 96
_OBJECTS = (
    "Bodies that the arm must not touch; sizes and positions in mm:",
    "[[object]]",
    'name = "table"',
    "box = [800, 600, 40]",
    "pose = { position = [900, 0, -20] }",
)
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_ANALOG = (SignalKind.AI, SignalKind.AO)


@value_class(frozen=True, slots=True)
class TemplateRobot:
    """An arm of the cell."""

    label: str | None = None
    """Its name, if there are several arms."""
    model: str | None = None
    """None if no arm of the catalogue is named."""
    remark: str = NOT_NAMED


@value_class(frozen=True, slots=True)
class TemplateTask:
    """A task of the cell."""

    name: str
    modules: tuple[str, ...]
    """Paths relative to the folder of the file, with `/`."""
    kind: TaskKind = TaskKind.NORMAL
    moves: bool = True
    robot: str | None = None
    entry: str | None = None
    refers_late: bool = False


@value_class(frozen=True, slots=True)
class SuggestedStimulus:
    """A value that a program waits for, and that nothing sets."""

    signal: str
    value: float
    after: str | None = None
    """Output that the program sets before, as a condition; None if it sets no output."""


@value_class(frozen=True, slots=True)
class Suggestions:
    """Tables that a user may want, written as comments without effect."""

    arm: str | None = None
    """Reason why the arm should be named."""
    signals: tuple[SignalDeclaration, ...] = ()
    """Signals that programs use and a backup does not declare."""
    missing: tuple[str, ...] = ()
    """Other undeclared names that they use, each with its possible meaning."""
    stimuli: tuple[SuggestedStimulus, ...] = ()
    undriven: tuple[str, ...] = ()
    """Other inputs that nothing sets."""
    objects: bool = False
    """Whether the programs move an arm that could collide."""


@value_class(frozen=True, slots=True)
class StationTemplate:
    """Content of a template."""

    remarks: tuple[str, ...] = ()
    """Comments at the top."""
    robots: tuple[TemplateRobot, ...] = ()
    """Arms; empty if a backup describes them all."""
    tasks: tuple[TemplateTask, ...] = ()
    """Tasks; empty if there is only one, or a backup describes them all."""
    signals: tuple[SignalDeclaration, ...] = ()
    missing: tuple[str, ...] = ()
    """Undeclared names of routines, types and data, each with its possible meaning."""
    suggestions: Suggestions = field(default_factory=Suggestions)


def draft_text(draft: StationTemplate) -> str:
    """Return the text of the file."""
    blocks = [
        [f"# {remark}" for remark in draft.remarks],
        *(list(_robot(robot, several=len(draft.robots) > 1)) for robot in draft.robots),
        *(list(_task(task)) for task in draft.tasks),
    ]
    if draft.signals:
        blocks.append(["[signals]", *(_signal(one) for one in draft.signals)])
    if draft.missing:
        blocks.append(list(_missing(draft.missing)))
    for block in _suggested(draft.suggestions):
        blocks.append([f"# {line.removeprefix('# ')}".rstrip() for line in block])
    return "\n\n".join("\n".join(block) for block in blocks if block) + "\n"


def _suggested(suggestions: Suggestions) -> Iterator[Sequence[str]]:
    """Yield a block of lines per suggestion."""
    if suggestions.arm is not None:
        yield (f"The arm: {suggestions.arm}.", "[robot]", 'model = "..."')
    if suggestions.signals:
        declared = map(_signal, suggestions.signals)
        yield ("Used by the programs, and not declared in EIO.cfg:", "[signals]", *declared)
    if suggestions.missing:
        yield tuple(_missing(suggestions.missing))
    if suggestions.stimuli:
        yield ("Inputs that a program waits for and nothing sets; what does, and when?",)
        for one in suggestions.stimuli:
            after = None if one.after is None else json.dumps(one.after)
            when = "at = 2.0" if after is None else f"when = {after}\nafter = 0.4"
            yield (
                "[[stimulus]]",
                *when.split("\n"),
                f"set = {{ {_key(one.signal)} = {one.value:.10g} }}",
            )
    if suggestions.undriven:
        yield (f"Other inputs that nothing sets: {', '.join(suggestions.undriven)}",)
        if not suggestions.stimuli:
            # A loop that polls them does not end a run: the example is a pulse.
            first = _key(suggestions.undriven[0])
            yield ("[[stimulus]]", "at = 1.0", "pulse = 0.5", f"set = {{ {first} = 1 }}")
    if suggestions.objects:
        yield _OBJECTS


def _missing(names: Sequence[str]) -> Iterator[str]:
    yield "[check]"
    yield "# These names are declared nowhere here. Calls of them are skipped, tools are tool0, and"
    yield "# the headline of each run counts it. Delete this when the modules are here:"
    yield from textwrap.wrap(", ".join(names), _WIDTH, initial_indent="# ", subsequent_indent="# ")
    yield "assume-missing = true"


def _robot(robot: TemplateRobot, *, several: bool) -> Iterator[str]:
    yield "[[robot]]" if several else "[robot]"
    if robot.label is not None and several:
        yield f"name = {json.dumps(robot.label)}"
    if robot.model is not None:
        yield f"model = {json.dumps(robot.model)}"
    else:
        yield f'# model = "..."   # {robot.remark}'


def _task(task: TemplateTask) -> Iterator[str]:
    yield "[[task]]"
    yield f"name = {json.dumps(task.name)}"
    yield f"modules = {json.dumps(list(task.modules), ensure_ascii=False)}"
    if task.kind is not TaskKind.NORMAL:
        yield f"type = {json.dumps(task.kind.value)}"
    if task.entry is not None:
        yield f"entry = {json.dumps(task.entry)}"
    if task.refers_late:
        yield "check_references = false"
    if not task.moves:
        yield "motion = false"
    elif task.robot is not None:
        yield f"robot = {json.dumps(task.robot)}"


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else json.dumps(name)


def _signal(signal: SignalDeclaration) -> str:
    name = _key(signal.name)
    parts = [f'type = "{signal.kind}"']
    if signal.status is not None:
        parts.append(f"system = {json.dumps(signal.status.value)}")
        parts += [] if signal.task is None else [f"task = {json.dumps(signal.task)}"]
        parts += [] if signal.unit == FIRST_ROBOT else [f"unit = {json.dumps(signal.unit)}"]
    elif signal.value:
        parts.append(f"value = {signal.value:.10g}")
    if signal.width not in (None, GROUP_WIDTH):
        parts.append(f"width = {signal.width}")
    if signal.kind in _ANALOG:
        limits = (("min", signal.lowest), ("max", signal.highest))
        parts += [f"{key} = {limit:.10g}" for key, limit in limits if limit is not None]
    return f"{name} = {{ {', '.join(parts)} }}"
