r"""Loading modules: parts of the program that are added and removed while it runs.

Files are in the home folder. Loading and saving take no virtual time. `\Dynamic` has no effect
within a run: it concerns modules when an operator sets the program pointer to main, which no run
does. Only a change of the program text counts as a change of a module, and no run changes it, so
ERR_NOTSAVED is never raised.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Load", "UnLoad",
"StartLoad", "WaitLoad", "CancelLoad", "EraseModule", "CheckProgRef", "Save", "ModExist".
"""

from __future__ import annotations

from rapidsim.diagnostics import Source
from rapidsim.language.annotations import Bool, LoadSessionVar, String, Switch, TaskId, Var
from rapidsim.language.controller import Controller
from rapidsim.language.error_numbers import (
    ERR_IOERROR,
    ERR_LOADNO_INUSE,
    ERR_LOADNO_NOUSE,
    ERR_PATH,
    ERR_UNKPROC,
    ERR_UNLOAD,
    rapid_error,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode, Files
from rapidsim.language.modules import LoadSession, SavedModule
from rapidsim.library.files import joined_path
from rapidsim.library.table import routine, table
from rapidsim.library.task_arguments import means_another
from rapidsim.library.traits import Trait

LARGEST_FILE = 10_000_000
"""Maximum size [bytes] of a program file; a larger one exceeds the program memory."""


def load(
    controller: Controller,
    file_path: String,
    *,
    dynamic: Switch = False,
    file: String | None = None,
    check_ref: Switch = False,
) -> None:
    """Load a module from a file into the program, with its initial values."""
    del dynamic
    path = joined_path(file_path, file)
    source = _read(controller.files, path)
    with controller.clock.long_work():
        controller.modules.load(source, path, check_references=check_ref)


def start_load(
    controller: Files,
    file_path: String,
    load_no: Var[LoadSessionVar],
    *,
    dynamic: Switch = False,
    file: String | None = None,
) -> None:
    """Read a module's file; WaitLoad adds it to the program, or raises the error of the attempt."""
    del dynamic
    if load_no.value is not None:
        raise rapid_error(
            ERR_LOADNO_INUSE, f"the load session holds {load_no.value.path}, which no WaitLoad took"
        )
    path = joined_path(file_path, file)
    try:
        load_no.value = LoadSession(path, _read(controller, path))
    except RapidError as error:
        load_no.value = LoadSession(path, error)


def wait_load(
    controller: Controller,
    load_no: Var[LoadSessionVar],
    *,
    unload_path: String | None = None,
    unload_file: String | None = None,
    check_ref: Switch = False,
) -> None:
    """Add the module that StartLoad has read, after unloading another one if a path names it."""
    session = _session(load_no.value, ERR_UNKPROC)
    if unload_path is not None:
        with controller.clock.long_work():
            controller.modules.unload(joined_path(unload_path, unload_file))
    load_no.value = None
    if isinstance(session.source, RapidError):
        raise session.source
    with controller.clock.long_work():
        controller.modules.load(session.source, session.path, check_references=check_ref)


def cancel_load(load_no: Var[LoadSessionVar]) -> None:
    """Discard a module that StartLoad has read."""
    _session(load_no.value, ERR_LOADNO_NOUSE)
    load_no.value = None


def un_load(
    controller: Controller,
    file_path: String,
    *,
    err_if_changed: Switch = False,
    save: Switch = False,
    file: String | None = None,
) -> None:
    """Unload the module that was loaded from a file."""
    path = joined_path(file_path, file)
    modules = controller.modules.loaded_from(path)
    if err_if_changed and any(module.text != module.loaded_text for module in modules):
        controller.fidelity.not_simulated(
            r"UnLoad \ErrIfChanged", "values of persistents are no change of a module"
        )
    if save and len(modules) == 1:
        _write(controller.files, modules[0], path)
    elif save and modules:
        raise rapid_error(
            ERR_UNLOAD, f"{path} holds {len(modules)} modules; saving them is not simulated"
        )
    with controller.clock.long_work():
        controller.modules.unload(path)


def erase_module(controller: Controller, module_name: String) -> None:
    """Remove a module by its name, however it was loaded."""
    if controller.modules.is_unread(module_name):
        controller.fidelity.not_simulated("EraseModule of a module that cannot be read", "skipped")
        return
    with controller.clock.long_work():
        controller.modules.erase(module_name)


def check_prog_ref(controller: Controller) -> None:
    """Raise ERR_LINKREF if the program uses anything undeclared."""
    with controller.clock.long_work():
        controller.modules.check_references()


def mod_exist(controller: Controller, module_name: String) -> Bool:
    """Whether the task has a module of that name."""
    return controller.modules.has(module_name)


def save(
    controller: Controller,
    module_name: String,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    file_path: String | None = None,
    file: String | None = None,
) -> None:
    """Save a module to a file, with the present values of its persistents."""
    if means_another(controller.tasks, task_ref, task_name):
        controller.fidelity.not_simulated(r"Save \TaskRef, \TaskName", "skipped")
        return
    if controller.modules.is_unread(module_name):
        controller.fidelity.not_simulated("Save of a module that cannot be read", "skipped")
        return
    module = controller.modules.saved(module_name)
    path = module.loaded_from if file_path is None else joined_path(file_path, file)
    if path is None:
        raise rapid_error(
            ERR_PATH,
            rf"module {module.name} was not loaded with Load; name the file with \FilePath",
        )
    _write(controller.files, module, path)


def _session(session: LoadSession | None, default: float) -> LoadSession:
    if session is None:
        raise rapid_error(default, "no StartLoad has begun with this load session")
    return session


def _read(controller: Files, path: str) -> Source:
    return controller.read_module(path, LARGEST_FILE)


def _write(controller: Files, module: SavedModule, path: str) -> None:
    """Write a module's text."""
    try:
        file = controller.open_file(path, FileMode.WRITE)
        file.write(module.text.encode())
        file.close()
    except RapidError as error:
        raise rapid_error(ERR_IOERROR, error.message) from None


LOADING = table(
    routine("Load", load, r"\Dynamic FilePath \File \CheckRef", does=Trait.LOAD),
    routine("StartLoad", start_load, r"\Dynamic FilePath \File LoadNo", does=Trait.LOAD),
    routine("WaitLoad", wait_load, r"\UnloadPath \UnloadFile LoadNo \CheckRef", does=Trait.WAIT),
    routine("CancelLoad", cancel_load),
    routine("UnLoad", un_load, r"\ErrIfChanged|\Save FilePath \File"),
    routine("EraseModule", erase_module),
    routine("CheckProgRef", check_prog_ref),
    routine("ModExist", mod_exist, does=Trait.READ_TASK),
    routine("Save", save, r"\TaskRef|\TaskName ModuleName \FilePath \File"),
)
