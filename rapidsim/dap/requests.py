"""The requests of the protocol: one function each, for a session and the arguments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from rapidsim.dap.link import AdapterEnded
from rapidsim.dap.session import DapRequestError, DebugSession, Later
from rapidsim.dap.time_search import TimeSearch
from rapidsim.dap.wire import Message
from rapidsim.interpreter.tools.debugging import StopReason
from rapidsim.interpreter.tools.step_positions import StepGranularity

_STEPS = MappingProxyType(
    {
        "next": StepGranularity.SAME_ROUTINE,
        "stepIn": StepGranularity.ANY,
        "stepOut": StepGranularity.CALLER,
        # No request of the protocol: a prompt sends it.
        "stepIntoTraps": StepGranularity.ANY_WITH_TRAPS,
    }
)


def set_breakpoints(session: DebugSession, arguments: Message) -> Message:
    """Replace the breakpoints of a source."""
    path = arguments["source"]["path"]
    wanted = arguments.get("breakpoints") or [
        {"line": line} for line in arguments.get("lines") or ()
    ]
    session.state.breakpoints[path] = wanted
    return {"breakpoints": session.breakpoints.set(path, wanted)}


def set_exception_breakpoints(session: DebugSession, arguments: Message) -> Message:
    """Replace the filters of errors."""
    filters = dict.fromkeys(arguments.get("filters") or (), "")
    for one in arguments.get("filterOptions") or ():
        filters[one["filterId"]] = one.get("condition") or ""
    session.state.filters = filters
    session.set_filters()
    return {}


def data_breakpoint_info(session: DebugSession, arguments: Message) -> Message:
    """Whether a name can have a data breakpoint."""
    return session.stopped().data_breakpoint_info(arguments)


def set_data_breakpoints(session: DebugSession, arguments: Message) -> Message:
    """Replace the data breakpoints."""
    names = [one["dataId"] for one in arguments.get("breakpoints") or ()]
    session.state.watchpoints = names
    session.breakpoints.watch(names)
    return {"breakpoints": [{"verified": True} for _ in names]}


def configuration_done(session: DebugSession, arguments: Message) -> Message:
    """Begin; see `configure`."""
    return {}


def threads(session: DebugSession, arguments: Message) -> Message:
    """The tasks."""
    tasks = () if session.run is None else session.run.tasks()
    names = [one.setup.name for one in tasks] or session.files.tasks
    return {"threads": [{"id": k, "name": name} for k, name in enumerate(names, 1)]}


def go_on(session: DebugSession, arguments: Message) -> Later:
    """Continue."""
    session.stopped()
    session.debugger.go_on()
    return Later({"allThreadsContinued": True}, session.resume)


def step(session: DebugSession, arguments: Message, reach: StepGranularity) -> Later:
    """Step in the task of a thread."""
    stopped = session.stopped()
    thread = int(arguments.get("threadId") or stopped.thread)
    frame = stopped.innermost(thread)
    if frame is None:
        raise DapRequestError("this task does not run")
    session.debugger.step(reach, frame, stopped.task(thread).controller.clock)
    session.stepped_from = stopped.stop.number
    return Later({}, session.resume)


def step_back(session: DebugSession, arguments: Message) -> Later:
    """Go to where the last step came from, else to the statement before in the task."""
    number = session.stopped().stop.number
    steps = session.state.steps
    while steps and steps[-1][0] > number:
        steps.pop()
    came_from = steps.pop()[1] if steps and steps[-1][0] == number else 0
    before = came_from or session.debugger.number_before(number)
    if not before:
        raise DapRequestError("this is the first statement of the task")
    return Later({}, lambda: session.go_to(before, StopReason.STEP))


def reverse_continue(session: DebugSession, arguments: Message) -> Later:
    """Go to the last stop before this one."""
    number = session.stopped().stop.number

    def survey() -> None:
        session.state.survey_until = number
        session.hand_over(max(1, number - 1))

    return Later({}, survey)


def restart(session: DebugSession, arguments: Message) -> Later:
    """Begin again, without what the user has changed."""
    session.state.changes = []
    session.state.unhandled_error = session.state.printed = 0
    return Later({}, lambda: session.go_to(1, StopReason.ENTRY))


def restart_frame(session: DebugSession, arguments: Message) -> Later:
    """Go to the first statement of a routine that runs."""
    frame = session.stopped().frame(int(arguments["frameId"]))
    number = session.debugger.first_number(frame)
    return Later({}, lambda: session.go_to(number, StopReason.GOTO))


def pause(session: DebugSession, arguments: Message) -> Message:
    """Stop before the next statement."""
    session.debugger.pause()
    return {}


def stack_trace(session: DebugSession, arguments: Message) -> Message:
    """The routines that a task runs."""
    return session.stopped().stack_trace(arguments)


def scopes(session: DebugSession, arguments: Message) -> Message:
    """The scopes of a routine; none if it is of an earlier stop.

    After `until` in the console a client asks for those of the stop before, and would show a
    refusal to the user.
    """
    try:
        return session.stopped().scopes(arguments)
    except LookupError:
        return {"scopes": []}


def variables(session: DebugSession, arguments: Message) -> Message:
    """The lines below a scope or value."""
    stopped = session.stopped()
    return {"variables": stopped.handles.unfolded(int(arguments["variablesReference"]))}


def evaluate(session: DebugSession, arguments: Message) -> object:
    """The value of an expression; in the console also `n := 5` and `until 2.5`."""
    stopped, text = session.stopped(), str(arguments["expression"])
    if arguments.get("context") == "repl":
        word, _, rest = text.strip().partition(" ")
        if word.lower() == "until":
            return _run_until(session, float(rest))
        name, becomes, value = text.partition(":=")
        if becomes:
            return {"result": _change(session, arguments, name, value), "variablesReference": 0}
    return stopped.evaluate(text, arguments)


def _run_until(session: DebugSession, time_s: float) -> object:
    session.stopped()
    if session.checkpoints is None:
        raise DapRequestError("this run has no copies, which would find the time")
    search = TimeSearch.start(time_s)
    if isinstance(search, TimeSearch):
        # This is the copy that searches: it runs on, and tells the number it finds.
        session.search = search
        session.debugger.breakpoints, session.debugger.stops_at_error = {}, None
        session.debugger.watch({})
        session.debugger.go_on()
        return Later(None, session.resume)
    number = search
    if number is None:
        raise DapRequestError(f"no statement begins at {time_s:g} s or later")
    session.debugger.run_to(number, StopReason.GOTO)
    return Later({"result": f"runs to {time_s:g} s", "variablesReference": 0}, session.resume)


def run_to_time(session: DebugSession, arguments: Message) -> object:
    """Run to the first statement at a virtual time [s] or after it."""
    return _run_until(session, float(arguments["time"]))


def set_variable(session: DebugSession, arguments: Message) -> Message:
    """Set data by name, in the scope of the stop."""
    path = session.stopped().handles.path(
        int(arguments["variablesReference"]), str(arguments["name"])
    )
    return {"value": _change(session, arguments, path, str(arguments["value"]))}


def set_expression(session: DebugSession, arguments: Message) -> Message:
    """Set data by an expression that names them."""
    text = _change(session, arguments, str(arguments["expression"]), str(arguments["value"]))
    return {"value": text}


def _change(session: DebugSession, arguments: Message, name: str, text: str) -> str:
    """Set a value now, and whenever the run gets here again."""
    stopped = session.stopped()
    change = stopped.change(name.strip(), text.strip(), arguments.get("frameId"))
    shown = stopped.assign(change)
    if session.checkpoints is not None:
        session.checkpoints.forget_after(stopped.stop.number)
    session.state.changes.append(change)
    return shown


def exception_info(session: DebugSession, arguments: Message) -> Message:
    """The error at which the program stopped."""
    stopped = session.stopped()
    error = stopped.stop.error
    name = stopped.text.partition(":")[0] if error is None else error.name
    return {
        "exceptionId": name or "error",
        "description": stopped.text,
        "breakMode": "unhandled" if error is None else "always",
    }


def loaded_sources(session: DebugSession, arguments: Message) -> Message:
    """The files of the program."""
    return {
        "sources": [
            {"name": Path(path).name, "path": path} for path in session.files.paths.values()
        ]
    }


def end(session: DebugSession, arguments: Message) -> Later:
    """End the session."""
    return Later({}, _leave)


def _leave() -> None:
    raise AdapterEnded


Handler = Callable[[DebugSession, Message], object]


def _stepping(reach: StepGranularity) -> Handler:
    return lambda session, arguments: step(session, arguments, reach)


HANDLERS: Mapping[str, Handler] = MappingProxyType(
    {
        "setBreakpoints": set_breakpoints,
        "setExceptionBreakpoints": set_exception_breakpoints,
        "dataBreakpointInfo": data_breakpoint_info,
        "setDataBreakpoints": set_data_breakpoints,
        "configurationDone": configuration_done,
        "threads": threads,
        "continue": go_on,
        **{name: _stepping(reach) for name, reach in _STEPS.items()},
        "stepBack": step_back,
        "reverseContinue": reverse_continue,
        "restart": restart,
        "restartFrame": restart_frame,
        "pause": pause,
        "stackTrace": stack_trace,
        "scopes": scopes,
        "variables": variables,
        "evaluate": evaluate,
        "runToTime": run_to_time,
        "setVariable": set_variable,
        "setExpression": set_expression,
        "exceptionInfo": exception_info,
        "loadedSources": loaded_sources,
        "terminate": end,
        "disconnect": end,
    }
)
"""Requests of the protocol that the debuggee handles."""
