"""Modules that clients load into a task, or unload from it."""

from __future__ import annotations

from rapidsim.diagnostics import Source
from rapidsim.files import InputError, decode
from rapidsim.interpreter.linking.loader import FatalError
from rapidsim.interpreter.linking.saved_text import text_of
from rapidsim.language.errors import RapidError
from rapidsim.language.modules import Modules
from rapidsim.library.loading import LARGEST_FILE
from rapidsim.module_files import module_names
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RefusalReason, RequestRefused
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse


def modules(task: LiveTask) -> tuple[tree.Module, ...]:
    """Current modules of a task."""
    return tuple(task.program.modules)


def load_module(task: LiveTask, path: str, *, replace: bool) -> None:
    """Load a module from a file into a stopped task, with its initial values.

    Args:
        task: The task.
        path: In RAPID's notation: `HOME:/part.mod`.
        replace: Whether a module of the same name is unloaded first.

    Raises:
        RequestRefused: If there is no such file or it does not fit.
    """
    memory = _memory(task)
    try:
        place, data = task.cell.home.read(path, LARGEST_FILE)
        source = Source(str(place), decode(data)[0])
        if replace:
            for one in parse(source).file.modules:
                if memory.has(one.name.text):
                    memory.erase(one.name.text)
        memory.load(source, path, check_references=False)
    except (RapidError, FatalError) as error:
        raise RequestRefused(RefusalReason.NO_FILE, str(error)) from None


def load_program(task: LiveTask, path: str) -> None:
    """Replace all program modules of a stopped task by the modules of a program file.

    Args:
        task: The task.
        path: In RAPID's notation, of a `.pgf` file, or of a module that is the whole program.

    Raises:
        RequestRefused: If a file is missing or invalid, and nothing has changed; or if the modules
            do not link, and the old ones are gone.
    """
    memory, home = _memory(task), task.cell.home
    try:
        place, data = home.read(path, LARGEST_FILE)
        folder, paths = path[: path.rfind("/") + 1], [path]
        if place.suffix.lower() == ".pgf":
            paths = [f"{folder}{name}" for name in module_names(place, data)]
        read = [home.read(one, LARGEST_FILE) for one in paths]
        sources = [Source(str(file), decode(text)[0]) for file, text in read]
        for source in sources:
            wrong = parse(source).diagnostics
            if wrong:
                raise RequestRefused(RefusalReason.NO_FILE, f"{wrong[0].file}: {wrong[0].message}")
        for one in modules(task):
            if not is_system_module(one):
                memory.erase(one.name.text)
        for source, one_path in zip(sources, paths, strict=True):
            memory.load(source, one_path, check_references=False)
    except (RapidError, FatalError, InputError) as error:
        raise RequestRefused(RefusalReason.NO_FILE, str(error)) from None


def is_system_module(module: tree.Module) -> bool:
    """Whether a module stays when another program is loaded."""
    return "sysmodule" in {word.key for word in module.attributes}


def unload_module(task: LiveTask, name: str) -> None:
    """Unload a module from a stopped task.

    Raises:
        RequestRefused: If there is no module of this name, or the rest does not link without it.
    """
    try:
        _memory(task).erase(name)
    except (RapidError, FatalError) as error:
        raise RequestRefused(RefusalReason.NO_MODULE, str(error)) from None


def _memory(task: LiveTask) -> Modules:
    """Return the modules of a task, for changes.

    Raises:
        RequestRefused: If its program has failed before main, so that it has no modules.
    """
    if task.failure is not None:
        raise RequestRefused(
            RefusalReason.STATE, f"the program of {task.name} cannot be made ready: {task.failure}"
        )
    return task.run.controller.concerns.modules


def file_of(task: LiveTask, module: tree.Module) -> bytes:
    """Return a module as a file, with the current values of its persistents."""
    return encoded(text_of(module) if task.task is None else task.task.text_of(module))


def encoded(text: str) -> bytes:
    """Return a text in the encoding of controllers, or in UTF-8 if that has not all of it."""
    try:
        return text.encode("latin-1")
    except UnicodeEncodeError:
        return text.encode()
