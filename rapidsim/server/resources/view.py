"""The controller as the page for people shows it, as JSON.

Looking changes nothing: it is not in the journal, and in lock-step no time passes.
"""

from __future__ import annotations

import json
import math
from itertools import islice
from typing import Final

from rapidsim.controller.cell.description import SignalDeclaration
from rapidsim.controller.cell.pendant import Question
from rapidsim.interpreter.linking.saved_text import text_of
from rapidsim.language.data import UNUSED_AXIS
from rapidsim.language.moves import Place
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.server.messages import Answer, Look
from rapidsim.server.resources.codes import NOT_FOUND, as_answered, refused
from rapidsim.server.resources.context import Context
from rapidsim.server.resources.io_places import SignalPlaces
from rapidsim.simulation.live import program_memory
from rapidsim.simulation.live import signals as live_signals
from rapidsim.simulation.live.event_log import COMMON
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import active_frames, glance
from rapidsim.simulation.live.signals import limits
from rapidsim.simulation.live.states import Refused, TaskState

_ENTRIES: Final = 50
"""How many entries of the event log are shown."""


def looked(context: Context, look: Look) -> Answer:
    """The state of the controller, or the text of a module.

    Raises:
        RefusedRequest: If there is no such module.
    """
    if not look.module:
        shown = _state(context)
    else:
        try:
            shown = _text(context.live.task(look.task), look.module)
        except Refused as refusal:
            raise as_answered(refusal, 1) from None
    return Answer(content=json.dumps(shown, ensure_ascii=False, allow_nan=False).encode())


def _state(context: Context) -> dict[str, object]:
    live = context.live
    places = SignalPlaces(context)
    return {
        "time": round(live.now_s, 3),
        "clock": f"{live.date:%Y-%m-%d %H:%M:%S}",
        "executes": live.executes,
        "motors": live.motors.value,
        "mode": live.mode.value,
        "speed": live.speed_ratio,
        "cycle": live.cycle.value,
        "tasks": [_task(live.task(one.name), one) for one in live.task_states()],
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
            }
            for one in islice(live.log.entries(COMMON), _ENTRIES)
        ],
    }


def _task(task: LiveTask, state: TaskState) -> dict[str, object]:
    shown: dict[str, object] = {
        "name": task.name,
        "kind": state.kind,
        "executes": state.executes,
        "active": state.is_active,
        "routine": task.place.routine if task.has_pointer else "",
        "pointer": _place(task, task.place) if task.has_pointer else None,
        "modules": [one.name.text for one in program_memory.modules(task)],
    }
    if state.moves_robot:
        now = glance(task)
        tool, wobj = active_frames(task)
        external = zip(LETTERS, now.joints.extax, strict=True)
        shown |= {
            "motion": None if now.move is None else _place(task, now.move),
            "joints": [_number(one) for one in now.joints.robax if one != UNUSED_AXIS],
            "measures": [joint.measure for joint in task.unit.own.robot.joints],
            "external": {
                f"eax_{letter}": _number(one) for letter, one in external if one != UNUSED_AXIS
            },
            "position": [_number(one) for one in now.target.trans],
            "orientation": [_number(one, 4) for one in now.target.rot],
            "tool": tool,
            "wobj": wobj,
        }
    return shown


def _signal(context: Context, one: SignalDeclaration, places: SignalPlaces) -> dict[str, object]:
    low, high = limits(one)
    is_output = one.kind.value.endswith("o")
    return {
        "name": one.name,
        "kind": one.kind.value,
        "value": live_signals.value_of(context.live, one.name),
        "low": low if math.isfinite(low) else None,
        "high": high if math.isfinite(high) else None,
        "settable": one.status is None and (not is_output or places.may_be_written(one.name)),
    }


def _question(one: Question) -> dict[str, object]:
    return {
        "task": one.task,
        "prompt": one.prompt,
        "choices": [key for key in one.choices if key],
        "proposal": one.proposal,
    }


def _text(task: LiveTask, module: str) -> dict[str, object]:
    for one in program_memory.modules(task):
        if one.name.key == module.lower():
            return {"module": one.name.text, "text": text_of(one)}
    raise refused(NOT_FOUND, f"{task.name} has no module {module}")


def _place(task: LiveTask, place: Place) -> list[object] | None:
    """Module and line of a place in the program of a task; the first line of a text is 1."""
    for one in program_memory.modules(task):
        if one.source.file == place.span.file and one.start <= place.span.start <= one.end:
            first = one.source.text.count("\n", 0, one.start)
            return [one.name.text, place.span.line - first]
    return None


def _number(value: float, digits: int = 2) -> float:
    return round(value, digits) + 0.0
