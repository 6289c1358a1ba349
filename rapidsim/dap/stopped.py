"""A stop as the client sees it: the routines of all tasks, scopes, values, the robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

from rapidsim.analysis.program import Storage
from rapidsim.dap.breakpoints import Breakpoints
from rapidsim.dap.checkpoints import ObservationError, observed_in_copy
from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.state import Change
from rapidsim.dap.variables import Handles, Variable, variable
from rapidsim.dap.wire import Message
from rapidsim.diagnostics import Span
from rapidsim.interpreter.tools.assignments import assign
from rapidsim.interpreter.tools.debugging import Debugger, Stop
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    data_of,
    local_names,
    module_names,
    place_of,
    value_at,
)
from rapidsim.interpreter.tools.step_positions import rapid_frames
from rapidsim.language.data import (
    ConfData,
    ExtJoint,
    JointTarget,
    Orient,
    Pos,
    RobJoint,
    RobTarget,
)
from rapidsim.library.predefined import TYPES
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.robot_state import robot_state
from rapidsim.simulation.task_run import TaskRun

_AT_ONCE_S = 0.15
"""Real time [s] for what is shown at each stop."""
_PATIENT_S = 20.0
"""Real time [s] for what the user asks for."""
_SCOPES = ("Routine", "Module", "Persistents", "Signals", "Robot")


@dataclass(eq=False)
class StoppedRun:
    """All tasks, stopped before a statement of one of them."""

    stop: Stop
    run: RunInProgress
    files: ProgramFiles
    debugger: Debugger
    breakpoints: Breakpoints
    text: str = ""
    """Description of the stop."""
    current: TaskRun = field(init=False)
    """The task that stopped."""
    handles: Handles = field(default_factory=Handles)
    _frames: list[FrameType] = field(default_factory=list)
    _states: dict[str, Message] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Note which task runs."""
        self.current = self.run.current

    @property
    def thread(self) -> int:
        """Number of the task that stopped, from 1."""
        return self.run.tasks().index(self.current) + 1

    def task(self, thread: int) -> TaskRun:
        """The task of a number.

        Raises:
            LookupError: If there is none.
        """
        tasks = self.run.tasks()
        if not 1 <= thread <= len(tasks):
            raise LookupError(f"there is no thread {thread}")
        return tasks[thread - 1]

    def innermost(self, thread: int) -> FrameType | None:
        """The innermost frame of a task; None if it does not run."""
        return next(iter(self.frames_of(self.task(thread))), None)

    def frame(self, number: int) -> FrameType:
        """The frame that the client knows by a number.

        Raises:
            LookupError: If it is of an earlier stop.
        """
        if not 1 <= number <= len(self._frames):
            raise LookupError("this routine is of an earlier stop")
        return self._frames[number - 1]

    def frames_of(self, task: TaskRun) -> Sequence[FrameType]:
        """Frames of the routines of a task, the innermost first."""
        outermost = self.stop.frame if task is self.current else self.run.frame_of(task)
        return list(rapid_frames(outermost))

    def number(self, frame: FrameType) -> int:
        """The number by which the client knows a frame."""
        if frame not in self._frames:
            self._frames.append(frame)
        return self._frames.index(frame) + 1

    def stack_trace(self, arguments: Message) -> Message:
        """The routines of a task, the innermost first, and a line about time and robot."""
        task = self.task(int(arguments.get("threadId") or self.thread))
        lines = [self._line_of(frame) for frame in self.frames_of(task)]
        if lines:
            lines.append({"id": 0, "name": self._label(task), "line": 0, "column": 0})
            lines[-1]["presentationHint"] = "label"
        first = int(arguments.get("startFrame") or 0)
        count = int(arguments.get("levels") or 0) or len(lines)
        return {"stackFrames": lines[first : first + count], "totalFrames": len(lines)}

    def _line_of(self, frame: FrameType) -> Message:
        span = self.debugger.place(frame).span if frame.f_lineno else None
        assert span is not None
        path = self.files.paths.get(span.file) or str(Path(span.file).absolute())
        return {
            "id": self.number(frame),
            "name": place_of(frame),
            "source": {"name": Path(path).name, "path": path},
            **_positions(span),
        }

    def _label(self, task: TaskRun) -> str:
        state = self.state(task, _AT_ONCE_S)
        if isinstance(state, str):
            return state
        move = state["move"]
        return f"t = {state['time_s']:.3f} s, " + (f"the robot is at {move}" if move else "at rest")

    def state(self, task: TaskRun, patience_s: float = _PATIENT_S) -> Message | str:
        """Time and robot of a task, as JSON values; or why they are not known.

        Args:
            task: The task.
            patience_s: Real time [s] that the planning of the path up to here may take.
        """
        name = task.setup.name
        if name not in self._states:
            try:
                found: Message = observed_in_copy(lambda: _state_message(task), patience_s)
            except ObservationError as error:
                return f"time unknown: {error}"
            self._states[name] = found
        return self._states[name]

    def scopes(self, arguments: Message) -> Message:
        """The scopes of a routine."""
        number = int(arguments["frameId"])
        frame = self.frame(number)
        task = self._task_of(frame)
        children = (
            lambda: _values(local_names(frame), frame),
            lambda: _values(module_names(frame), frame),
            lambda: _values(module_names(frame, Storage.PERS), frame),
            self._signals,
            lambda: self._robot(task),
        )
        return {
            "scopes": [
                {
                    "name": name,
                    "variablesReference": self.handles.number(unfold),
                    "expensive": name != "Routine",
                    **({"presentationHint": "locals"} if name == "Routine" else {}),
                }
                for name, unfold in zip(_SCOPES, children, strict=True)
            ]
        }

    def _task_of(self, frame: FrameType) -> TaskRun:
        tasks = self.run.tasks()
        return next((one for one in tasks if frame in self.frames_of(one)), self.current)

    def _signals(self) -> Iterable[Variable]:
        for signal in self.run.cell.declared:
            value = self.run.cell.signals.read(signal.name)
            yield Variable(signal.name, f"{value:g}", signal.kind.value, f"signal:{signal.name}")

    def _robot(self, task: TaskRun) -> Iterable[Variable]:
        state = self.state(task)
        if isinstance(state, str):
            yield Variable("state", state)
            return
        yield Variable("time", f"{state['time_s']:.6f} s")
        yield Variable("motion pointer", state["move"] or "at rest")
        yield Variable("program pointer", _place_text(self.stop.place.span))
        yield Variable("TCP speed", f"{state['speed']:.1f} mm/s")
        yield Variable("tool", state["tool"], "tooldata", state["tool"])
        yield Variable("work object", state["wobj"], "wobjdata", state["wobj"])
        position, rotation, configuration, external = state["target"]
        target = RobTarget(
            Pos(*position), Orient(*rotation), ConfData(*configuration), ExtJoint(*external)
        )
        axes = JointTarget(RobJoint(*state["joints"]), ExtJoint(*state["external"]))
        yield variable("pose", target, TYPES["robtarget"], "")
        yield variable("axes", axes, TYPES["jointtarget"], "")

    def evaluate(self, text: str, arguments: Message) -> Message:
        """The value of an expression in a routine."""
        number = arguments.get("frameId")
        frame = self.frame(int(number)) if number else self.stop.frame
        try:
            value, of = value_at(text, frame)
        except NotShownError:
            shown, type_name = self.breakpoints.value(text, frame)
            return {"result": shown, "type": type_name, "variablesReference": 0}
        line = self.handles.line(variable(text, value, of, text))
        return {
            "result": line["value"],
            "type": line["type"],
            "variablesReference": line["variablesReference"],
        }

    def data_breakpoint_info(self, arguments: Message) -> Message:
        """Identity of data or a signal for a data breakpoint; None with the reason if none."""
        name = str(arguments["name"])
        reference = arguments.get("variablesReference")
        path = self.handles.path(int(reference), name) if reference else name
        if path.startswith("signal:"):
            return {"dataId": path, "description": name, "accessTypes": ["write"]}
        if any(path.lower() == one.lower() for one in local_names(self.stop.frame)):
            return {"dataId": None, "description": f"`{name}` is data of a routine"}
        task = self._task_of(self.stop.frame).setup.name
        if any(path.lower() == one.lower() for one in module_names(self.stop.frame)) or any(
            path.lower() == one.lower() for one in module_names(self.stop.frame, Storage.PERS)
        ):
            return {"dataId": f"{task}/{path}", "description": name, "accessTypes": ["write"]}
        return {"dataId": None, "description": f"`{name}` is not data of a module, or a signal"}

    def change(self, name: str, text: str, frame_number: object) -> Change:
        """The change of data, a part of them, or a signal."""
        frame = self.frame(int(str(frame_number))) if frame_number else self.stop.frame
        task = self._task_of(frame)
        depth = list(self.frames_of(task)).index(frame)
        return Change(self.stop.number, task.setup.name, depth, name, text)

    def assign(self, change: Change) -> str:
        """Set data or a signal; return the new value.

        Raises:
            NotShownError: If that is impossible.
        """
        task = next(one for one in self.run.tasks() if one.setup.name == change.task)
        if change.name.startswith("signal:"):
            return self._set_signal(task, change.name.partition(":")[2], change.text)
        frame = self.frames_of(task)[change.depth]
        return assign(change.name, change.text, frame, task.controller.concerns.symbols)

    def _set_signal(self, task: TaskRun, name: str, text: str) -> str:
        try:
            value = float(text)
        except ValueError:
            raise NotShownError(f"`{text}` is no number") from None
        clock = task.controller.clock
        clock.synchronise()
        self.run.cell.set_signal(clock.cause(), clock.moment(), name, value)
        return f"{value:g}"


def _positions(span: Span) -> Message:
    (line, column), (end_line, end_column) = (
        span.source.position(span.start),
        span.source.position(span.end),
    )
    return {"line": line, "column": column, "endLine": end_line, "endColumn": end_column}


def _place_text(span: Span) -> str:
    return f"{span.file}:{span.line}: {span.text.splitlines()[0] if span.text else ''}"


def _values(names: Iterable[str], frame: FrameType) -> Iterable[Variable]:
    for name in names:
        try:
            value, of = data_of(name, frame)
        except NotShownError as error:
            yield Variable(name, f"({error})")
            continue
        yield variable(name, value, of, name)


def _state_message(task: TaskRun) -> Message:
    """Time and robot of a task as JSON values."""
    state = robot_state(task)
    return {
        "time_s": state.time_s,
        "move": None if state.move is None else _place_text(state.move.span),
        "speed": state.tcp_speed_mm_s,
        "tool": state.tool,
        "wobj": state.wobj,
        "joints": list(state.joints.robax),
        "external": list(state.joints.extax),
        "target": [list(part) for part in state.target],
    }
