"""Programs: starting and stopping them, tasks, pointers, modules."""

from __future__ import annotations

from pathlib import Path

from rapidsim.interpreter.linking.saved_text import text_of
from rapidsim.language.moves import Place
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import (
    BAD_PARAMETER,
    LATER_NO_MODULE,
    NO_POINTER,
    NOT_FOUND,
    refused,
)
from rapidsim.server.resources.context import RequestContext, chosen, count, required_value
from rapidsim.server.resources.disks import path_of_programs
from rapidsim.simulation.live import program_memory
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import position_snapshot
from rapidsim.simulation.live.states import Cycle, ExecutionMode, StopMode, TaskState
from rapidsim.syntax import tree

_NOT_SIMULATED = frozenset({"stepback", "steplast"})


def execution(context: RequestContext, request: Request) -> Answer:
    """Whether programs are executing, and the cycle mode."""
    del request
    return Answer((execution_item(context),))


def execution_item(context: RequestContext) -> Item:
    """Return the state of execution as an item."""
    live = context.live
    executes = "running" if live.executes else "stopped"
    return Item(
        "rap-execution", "execution", {"ctrlexecstate": executes, "cycle": live.cycle.value}
    )


def start(context: RequestContext, request: Request) -> Answer:
    """Start the programs.

    Raises:
        RefusedRequest: For a mode of execution that is not simulated, or if another session holds
            the mastership.
    """
    context.require_unclaimed(request)
    if request.form.get("execmode") in _NOT_SIMULATED:
        mode = request.form["execmode"]
        raise refused(BAD_PARAMETER, f"{mode} is not simulated: steps only go forward")
    how = ExecutionMode.CONTINUE
    if "execmode" in request.form:
        how = chosen(request.form, "execmode", ExecutionMode)
    asked = request.form.get("cycle", "asis")
    cycle = None if asked == "asis" else chosen(request.form, "cycle", Cycle)
    context.live.start(cycle, how)
    return DONE


def start_production(context: RequestContext, request: Request) -> Answer:
    """Start the programs from main."""
    del request
    context.live.reset_pointers()
    context.live.start()
    return DONE


def stop(context: RequestContext, request: Request) -> Answer:
    """Stop the programs."""
    how = StopMode.STOP
    if "stopmode" in request.form:
        how = chosen(request.form, "stopmode", StopMode)
    context.live.stop(how)
    return DONE


def reset_pointers(context: RequestContext, request: Request, task: str = "") -> Answer:
    """Set the pointer of a task, or of all, to main."""
    context.require_mastership("rapid", request)
    context.live.reset_pointers(task)
    return DONE


def set_cycle(context: RequestContext, request: Request) -> Answer:
    """Set the cycle mode."""
    context.live.cycle = chosen(request.form, "cycle", Cycle)
    return DONE


def tasks(context: RequestContext, request: Request) -> Answer:
    """All tasks; in RobotWare 7 the service that watches them comes first."""
    items = tuple(_task_item(one) for one in context.live.task_states())
    if request.generation == 2:
        items = (Item("rap-tasks-spy-li", "spy", href="rw/rapid/tasks/spy"), *items)
    return Answer(resources=items)


def task(context: RequestContext, request: Request, task: str) -> Answer:
    """One task."""
    del request
    name = context.live.task(task).name
    items = (_task_item(one) for one in context.live.task_states() if one.name == name)
    return Answer(tuple(items), links=("pcp", "program"))


def spy(context: RequestContext, request: Request) -> Answer:
    """Whether the controller logs statements for clients, which it never does here."""
    del context, request
    return Answer((Item("rap-spy-status", "spy", {"status": "Not Logging"}),))


def activate(context: RequestContext, request: Request, task: str | None = None) -> Answer:
    """Activate a task, or all."""
    context.live.activate(task or request.form.get("task"), active=True)
    return DONE


def deactivate(context: RequestContext, request: Request, task: str | None = None) -> Answer:
    """Deactivate a task, or all."""
    context.live.activate(task or request.form.get("task"), active=False)
    return DONE


def pointers(context: RequestContext, request: Request, task: str) -> Answer:
    """The positions of the program pointer and of the motion pointer of a task.

    A pointer that is nowhere is an error in RobotWare 8, and absent before.
    """
    found = context.live.task(task)
    is_later = request.generation == 2 and context.has_control_stations
    begin = "begposition" if request.generation == 1 else "beginposition"
    motion = position_snapshot(found).move if found.setup.robot else None
    # These names of fields are spelt so by controllers.
    places = (
        ("progpointer", found.place if found.has_pointer else None, "modulemame", "beginposition"),
        ("motionpointer", motion, "modulename", begin),
    )
    items = []
    for title, place, *names in places:
        if place is not None:
            fields = _pointer(found, place, *names)
            items.append(Item("pcp-info", title, fields, is_nested=is_later))
        elif is_later:
            items.append(Item("pcp-info", title, is_nested=True, error=NO_POINTER))
    return Answer(tuple(items), base="rw/rapid" if is_later else None)


def _pointer(task: LiveTask, place: Place, module: str, begin: str) -> dict[str, str]:
    span = place.span
    return {
        module: _module_at(task, place),
        "routinename": place.routine,
        begin: f"{span.line},{span.column}",
        "endposition": f"{span.end_line},{span.end_column}",
        "executiontype": "normal",
    }


def program(context: RequestContext, request: Request, task: str) -> Answer:
    """The program of a task."""
    del request
    found = context.live.task(task)
    fields = {"name": found.setup.program.modules[0].name.text, "entrypoint": found.entry}
    return Answer((Item("rap-program", "program", fields),))


def modules(context: RequestContext, request: Request, task: str | None = None) -> Answer:
    """The modules of a task."""
    found = context.live.task(task or required_value(request.query, "task"))
    items = (_module_item(found, one) for one in program_memory.modules(found))
    return Answer(tuple(items), base="rw/rapid")


def module(
    context: RequestContext, request: Request, module: str, task: str | None = None
) -> Answer:
    """One module of a task, or with `resource=module-text` its text.

    Raises:
        RefusedRequest: If no module has this name.
    """
    if request.query.get("resource") == "module-text":
        return module_text(context, request, module, task)
    of = context.live.task(task or required_value(request.query, "task"))
    found = _module(of, module)
    fields = {"taskname": of.name} if request.generation == 1 else {}
    fields |= {
        "modname": found.name.text,
        "filename": Path(found.source.file).name,
        "attribute": ",".join(one.key.replace("sysmodule", "sysmod") for one in found.attributes),
    }
    item = Item("rap-module", f"{of.name}/{found.name.text}", fields)
    return Answer((item,), links=("text",) if request.generation == 2 else ())


def module_text(
    context: RequestContext, request: Request, module: str, task: str | None = None
) -> Answer:
    """The text of a module, as it was loaded."""
    found = _module(context.live.task(task or required_value(request.query, "task")), module)
    text = text_of(found)
    fields = {"change-count": "0", "module-text": text, "module-length": str(len(text))}
    return Answer((Item("rap-module-text", found.name.text, fields),))


def save_module(
    context: RequestContext, request: Request, module: str, task: str | None = None
) -> Answer:
    """Save a module to a file, whose extension the controller adds."""
    of = context.live.task(task or required_value(request.query, "task"))
    name, folder = (required_value(request.form, one) for one in ("name", "path"))
    address = f"{folder.rstrip('/')}/{name}.mod{'' if request.generation == 1 else 'x'}"
    context.files.write(address, program_memory.file_of(of, _module(of, module)))
    return DONE


def load_module(context: RequestContext, request: Request, task: str) -> Answer:
    """Load a module from a file into a task."""
    context.require_mastership("rapid", request)
    form = request.form
    replace = form.get("replace", "false").lower() == "true"
    path = form.get("modulepath", "")
    found = context.live.stopped_task(task)
    program_memory.load_module(found, path_of_programs(path), replace=replace)
    return DONE


def load_program(context: RequestContext, request: Request, task: str) -> Answer:
    """Load a program from a file in place of the current one."""
    context.require_mastership("rapid", request)
    program_memory.load_program(
        context.live.stopped_task(task), path_of_programs(request.form.get("progpath", ""))
    )
    return DONE


def put_pointer(context: RequestContext, request: Request, task: str) -> Answer:
    """Set the pointer of a task to a routine."""
    context.require_mastership("rapid", request)
    routine = required_value(request.form, "routine")
    context.live.put_pointer(task, request.form.get("module", ""), routine)
    return DONE


def set_breakpoint(context: RequestContext, request: Request, task: str) -> Answer:
    """Let the program halt before the statement on a line of a module, from the next start on.

    Raises:
        RefusedRequest: If the task has no such module.
    """
    found = context.live.task(task)
    found.breakpoints.add(_line(found, request))
    return DONE


def clear_breakpoint(context: RequestContext, request: Request, task: str) -> Answer:
    """Remove the breakpoint on a line of a module, if there is one."""
    found = context.live.task(task)
    found.breakpoints.discard(_line(found, request))
    return DONE


def _line(task: LiveTask, request: Request) -> tuple[str, int]:
    """Return the module and the line that a form names."""
    module = _module(task, required_value(request.form, "module"))
    return module.name.key, count(request.form, "row", 1)


def unload_module(context: RequestContext, request: Request, task: str) -> Answer:
    """Unload a module from a task."""
    context.require_mastership("rapid", request)
    program_memory.unload_module(context.live.stopped_task(task), request.form.get("module", ""))
    return DONE


def _task_item(task_state: TaskState) -> Item:
    stands = "stopped" if task_state.has_pointer else "uninitialized"
    fields = {
        "name": task_state.name,
        "type": task_state.kind,
        "taskstate": "linked" if task_state.is_loaded else "loaded",
        "excstate": "started" if task_state.executes else stands,
        "active": "On" if task_state.is_active else "Off",
        "motiontask": "TRUE" if task_state.moves_robot else "FALSE",
    }
    return Item("rap-task-li", task_state.name, fields, href=f"rw/rapid/tasks/{task_state.name}")


def _module(task: LiveTask, name: str) -> tree.Module:
    for one in program_memory.modules(task):
        if one.name.key == name.lower():
            return one
    raise refused(NOT_FOUND, f"{task.name} has no module {name}", LATER_NO_MODULE)


def _module_item(task: LiveTask, module: tree.Module) -> Item:
    kind = "SysMod" if program_memory.is_system_module(module) else "ProgMod"
    name = module.name.text
    return Item("rap-module-info-li", f"{task.name}/{name}", {"name": name, "type": kind})


def _module_at(found: LiveTask, place: Place) -> str:
    file = place.span.file
    inside = (one for one in program_memory.modules(found) if one.source.file == file)
    for one in inside:
        if one.start <= place.span.start <= one.end:
            return one.name.text
    return ""
