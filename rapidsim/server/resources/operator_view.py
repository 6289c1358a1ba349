"""State of the controller on the operator page, as JSON.

A read has no effect: it is not in the journal, and in lock-step no time passes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from itertools import islice
from types import MappingProxyType
from typing import Final, TypeAlias

from rapidsim.controller.cell.description import SignalDeclaration
from rapidsim.controller.cell.pendant import Question
from rapidsim.interpreter.linking.saved_text import text_of
from rapidsim.language.data import UNUSED_AXIS
from rapidsim.language.moves import Place
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.server.derived_parameters import robots
from rapidsim.server.messages import Answer, Fields, ReadState
from rapidsim.server.resources.codes import NOT_FOUND, as_answered, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.io_addresses import SignalAddresses
from rapidsim.server.resources.jogging import jog_panel
from rapidsim.server.resources.operator_panels import (
    arm_panel,
    backup_panel,
    joints_panel,
    rule_panel,
    task_panel,
)
from rapidsim.simulation.live import program_memory
from rapidsim.simulation.live import signals as live_signals
from rapidsim.simulation.live.event_log import COMMON, LogEntry
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import active_frames, position_snapshot
from rapidsim.simulation.live.signals import limits
from rapidsim.simulation.live.states import RequestRefused, TaskState

_ENTRIES: Final = 50
"""Number of entries of the event log that are shown."""


def looked(context: RequestContext, read_state: ReadState) -> Answer:
    """Return a part of the operator page.

    Raises:
        RefusedRequest: If there is no such part, or nothing of the names in the query.
    """
    view = VIEWS.get(read_state.view)
    if view is None:
        raise refused(NOT_FOUND, f"there is no view {read_state.view}")
    try:
        shown = view(context, read_state.query)
    except RequestRefused as refusal:
        raise as_answered(refusal, 1) from None
    if isinstance(shown, Answer):
        return shown
    return Answer(content=json.dumps(shown, ensure_ascii=False, allow_nan=False).encode())


def _state(context: RequestContext, query: Fields) -> dict[str, object]:
    del query
    live = context.live
    places = SignalAddresses(context)
    units = {setup.name: name for name, setup in robots(live.setups)}
    return {
        "time": round(live.now_s, 3),
        "clock": f"{live.date:%Y-%m-%d %H:%M:%S}",
        "executes": live.executes,
        "motors": live.panel.state.value,
        "pressed": live.panel.is_pressed,
        "mode": live.panel.mode.value,
        "speed": live.panel.speed_ratio,
        "cycle": live.cycle.value,
        "tasks": [
            _task(live.task(one.name), one, units.get(one.name, "")) for one in live.task_states()
        ],
        "signals": [_signal(context, one, places) for one in live_signals.declared(live)],
        "screen": list(live.screen),
        "questions": [_question(one) for one in live.pendant.questions.values()],
        "log": [
            {
                "number": one.number,
                "type": one.type,
                "code": one.code,
                "clock": f"{live.date_at(one.time_s):%H:%M:%S}",
                "title": one.title,
                "text": one.text,
                "rule": one.rule,
                "remedy": one.remedy,
                "place": _place_of_entry(context, one),
            }
            for one in islice(live.log.entries(COMMON), _ENTRIES)
        ],
    }


def _task(task: LiveTask, state: TaskState, unit: str) -> dict[str, object]:
    shown: dict[str, object] = {
        "name": task.name,
        "kind": state.kind,
        "executes": state.executes,
        "active": state.is_active,
        "routine": task.place.routine if task.has_pointer else "",
        "pointer": _place(task, task.place) if task.has_pointer else None,
        "modules": [one.name.text for one in program_memory.modules(task)],
        "breakpoints": sorted(map(list, task.breakpoints)),
    }
    if state.moves_robot:
        now = position_snapshot(task)
        tool, wobj = active_frames(task)
        external = zip(LETTERS, now.joints.extax, strict=True)
        shown |= {
            "mechunit": unit,
            "motion": None if now.move is None else _place(task, now.move),
            "joints": [_number(one) for one in now.joints.robax if one != UNUSED_AXIS],
            "measures": [joint.measure for joint in task.unit.member.robot.joints],
            "external": {
                f"eax_{letter}": _number(one) for letter, one in external if one != UNUSED_AXIS
            },
            "position": [_number(one) for one in now.target.trans],
            "orientation": [_number(one, 4) for one in now.target.rot],
            "tool": tool,
            "wobj": wobj,
        }
    return shown


def _signal(
    context: RequestContext, signal: SignalDeclaration, places: SignalAddresses
) -> dict[str, object]:
    low, high = limits(signal)
    is_output = signal.kind.value.endswith("o")
    return {
        "name": signal.name,
        "kind": signal.kind.value,
        "value": live_signals.value_of(context.live, signal.name),
        "low": low if math.isfinite(low) else None,
        "high": high if math.isfinite(high) else None,
        "settable": signal.status is None and (not is_output or places.may_be_written(signal.name)),
    }


def _question(question: Question) -> dict[str, object]:
    return {
        "task": question.task,
        "prompt": question.prompt,
        "choices": [key for key in question.choices if key],
        "proposal": question.proposal,
    }


def _text(context: RequestContext, query: Fields) -> dict[str, object]:
    task, module = context.live.task(query.get("task", "")), query.get("module", "")
    for one in program_memory.modules(task):
        if one.name.key == module.lower():
            return {"module": one.name.text, "text": text_of(one)}
    raise refused(NOT_FOUND, f"{task.name} has no module {module}")


def _module(context: RequestContext, query: Fields) -> Answer:
    """Return the text of a module, to be kept as a file."""
    return Answer(content=str(_text(context, query)["text"]).encode())


def _place(task: LiveTask, place: Place) -> list[object] | None:
    """Return module and line of a place in the program of a task; the first line of a text is 1."""
    found = task.module_line(place)
    return None if found is None else [*found]


def _place_of_entry(context: RequestContext, entry: LogEntry) -> list[object] | None:
    """Return task, module and line of the error that an entry is about."""
    for task in context.live.tasks.values() if entry.line else ():
        for one in program_memory.modules(task):
            first = one.source.text.count("\n", 0, one.start)
            last = one.source.text.count("\n", 0, one.end) + 1
            if one.source.file == entry.file and first < entry.line <= last:
                return [task.name, one.name.text, entry.line - first]
    return None


def _number(value: float, digits: int = 2) -> float:
    return round(value, digits) + 0.0


View: TypeAlias = Callable[[RequestContext, Fields], dict[str, object] | Answer]
VIEWS: Final[Mapping[str, View]] = MappingProxyType(
    {
        "state": _state,
        "text": _text,
        "module": _module,
        "arm": arm_panel,
        "joints": joints_panel,
        "jog": jog_panel,
        "task": task_panel,
        "rule": rule_panel,
        "backup.zip": backup_panel,
    }
)
"""Parts of the page by name; a query has further names."""
