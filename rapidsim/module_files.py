"""RAPID modules that a path names, by task.

A path may be a module, a `.pgf` program file, a folder, a controller backup, a `.rspag`, a
controller in one (`cell.rspag!NAME`), or `-`.
A link out of a folder is rejected: a repository that is checked is not trusted.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import islice
from pathlib import Path, PurePosixPath
from xml.parsers import expat

from rapidsim.backinfo import ListedTask, listed_tasks
from rapidsim.files import (
    InputError,
    SourceFile,
    decode,
    did_you_mean,
    entries_of,
    input_bytes,
    is_encoded,
    require_inside,
    standard_input,
)
from rapidsim.values import value_class

MODULE_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")
_PACKED = re.compile(r"(?P<file>.*\.rspag)(?:!(?P<controller>.+))?", re.IGNORECASE | re.DOTALL)
STANDARD_INPUT = "<stdin>"
CONFIGURATION_FILES = ("sys.cfg", "eio.cfg", "moc.cfg")
_CONFIGURED_IN = ("syspar", "config")
"""Subfolders with configuration files: of a backup, and of an add-in."""
_IN_TASK = ("PROGMOD", "SYSMOD")
"""Subfolders of a task's folder that contain its modules."""
_MOST_NAMED = 5
_DEEPEST = 5
"""Levels below a folder without modules that are searched for modules."""
_MOST_FOLDERS = 200
"""Maximum number of folders per level that are searched."""
_MODULE_HEADER = re.compile(r"^\s*(MODULE\s+\w|%%%)", re.IGNORECASE | re.MULTILINE)


@value_class(frozen=True, slots=True)
class Backup:
    """A controller backup, or a folder with the same layout."""

    root: Path
    tasks: tuple[Path, ...]
    """Folders of its tasks; empty if SYS.cfg loads every module from HOME."""


@value_class(frozen=True, slots=True)
class LooseCell:
    """A folder of modules that also has the configuration files of their controller."""

    root: Path
    below: tuple[str, ...]
    """Subfolders that lead to SYS.cfg, EIO.cfg or MOC.cfg: none, SYSPAR or config."""
    modules: tuple[Path, ...]


@value_class(frozen=True, slots=True)
class TaskFiles:
    """The modules of one task, in a fixed order."""

    name: str | None
    """Folder of the task in a backup, such as `TASK1`; None without a name."""
    files: tuple[SourceFile, ...]
    unseen: tuple[str, ...] = ()
    """Modules of the task that cannot be read here, each with the reason."""
    left_out: tuple[str, ...] = ()
    """Other files of the backup that the controller does not load."""
    refers_late: bool = False
    """Whether its controller loads it with unresolved references."""


def read_tasks(
    paths: Sequence[str], rooms: Sequence[Path] = (), *, more: bool = False
) -> tuple[TaskFiles, ...]:
    """Read all modules that the user names.

    Args:
        paths: Files, `.pgf` files, folders, or `-`. Together they are one task, except that each
            task folder of a controller backup is a separate task.
        rooms: Folders into which links may lead, in addition to the ones in `paths`.
        more: Whether there are other modules, so that a folder may have none.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID.
    """
    modules: list[str | Path] = []
    absent: list[str] = []
    tasks: list[TaskFiles] = []
    for path in paths:
        if path == "-":
            modules.append(path)
            continue
        found = opened(path)
        folders = task_folders(found) if found.is_dir() else ()
        if folders:
            for folder in folders:
                listed, left_out, missing = _in_task_folder(folder)
                read = _read(require_inside(listed, (found, *rooms)))
                unseen = (*read.unseen, *missing)
                tasks.append(replace(read, name=folder.name, unseen=unseen, left_out=left_out))
        elif found.is_dir():
            modules += require_inside(_in_folder(found, may_be_empty=more), (found, *rooms))
        elif found.suffix.lower() == ".pgf":
            named, not_there = _in_program_file(found)
            modules += require_inside(named, (found.parent, *rooms))
            absent += not_there
        else:
            modules.append(found)
    if modules:
        read = _read(modules)
        tasks.insert(0, replace(read, unseen=(*read.unseen, *absent)))
    if not tasks and not more:
        raise InputError("no RAPID file was named", "name a module, a .pgf file or a folder")
    return tuple(tasks)


def named_tasks(tasks: Sequence[TaskFiles], first: str) -> tuple[TaskFiles, ...]:
    """Return tasks with their names on a controller: one is `first`, several are numbered."""
    if len(tasks) == 1:
        return (replace(tasks[0], name=first),)
    return tuple(replace(task, name=f"T_ROB{number}") for number, task in enumerate(tasks, 1))


def task_folders(folder: Path) -> tuple[Path, ...]:
    """Return TASK1, TASK2 ... of a backup's RAPID folder, which `folder` is or contains.

    TASK0 contains the modules that the system installs in every task, and is no task. Next to a
    folder SYSPAR, the folders in RAPID may have the names of the tasks.
    """
    below = [entry for entry in entries_of(folder) if entry.name.upper() == "RAPID"]
    for entry in (folder, *below):
        if not entry.is_dir():
            continue
        tasks = [e for e in entries_of(entry) if re.fullmatch(r"TASK[1-9]\d*", e.name.upper())]
        if tasks:
            return tuple(sorted(tasks, key=lambda e: int(e.name[4:])))
        is_rapid = entry.name.upper() == "RAPID"
        if is_rapid and any(e.name.upper() == "SYSPAR" for e in entries_of(entry.parent)):
            return tuple(e for e in entries_of(entry) if _is_task_by_name(e))
    return ()


def _is_task_by_name(folder: Path) -> bool:
    """Whether a folder in RAPID is a task: it has modules, and is no subfolder of a task."""
    if not folder.is_dir() or folder.name.upper() in (*_IN_TASK, "TASK0"):
        return False
    return bool(_modules_below(folder))


def backup_among(paths: Iterable[str]) -> Backup | None:
    """Return the first controller backup among some paths; None without one."""
    return next((backup for _, backup in _backups(paths)), None)


def backups_among(paths: Iterable[str]) -> tuple[tuple[str, Backup], ...]:
    """Return the controller backups among some paths, each with its path."""
    return tuple(_backups(paths))


def _backups(paths: Iterable[str]) -> Iterator[tuple[str, Backup]]:
    for path in paths:
        folder = opened(path)
        if path == "-" or not folder.is_dir():
            continue
        tasks = task_folders(folder)
        if tasks:
            yield path, Backup(tasks[0].parent.parent, tasks)
            continue
        below = {entry.name.upper() for entry in entries_of(folder) if entry.is_dir()}
        if below >= {"SYSPAR", "HOME"} and not _in_folder(folder, may_be_empty=True):
            yield path, Backup(folder, ())


def loose_cell_among(paths: Iterable[str]) -> LooseCell | None:
    """Return the first folder with modules and configuration files in paths; None without one."""
    for path in paths:
        folder = opened(path)
        if path == "-" or not folder.is_dir():
            continue
        below = configuration_below(folder)
        modules = [] if below is None else _in_folder(folder, may_be_empty=True)
        if below is not None and modules:
            return LooseCell(folder, below, tuple(modules))
    return None


def has_modules(folder: Path) -> bool:
    """Whether a folder has modules, or the tasks of a backup."""
    return bool(task_folders(folder) or _in_folder(folder, may_be_empty=True))


def configuration_below(folder: Path) -> tuple[str, ...] | None:
    """Return the subfolders to configuration files: empty, SYSPAR or config; None without any."""
    if _has_configuration(folder):
        return ()
    for entry in entries_of(folder):
        if entry.name.lower() in _CONFIGURED_IN and entry.is_dir() and _has_configuration(entry):
            return (entry.name,)
    return None


def _has_configuration(folder: Path) -> bool:
    # An add-in puts its name before: StateMachine_eio.cfg.
    files = CONFIGURATION_FILES
    return any(entry.name.lower().rpartition("_")[2] in files for entry in entries_of(folder))


def opened(path: str) -> Path:
    """Return the file or folder of a path: itself, or the backup in a packed station (`.rspag`).

    Raises:
        InputError: If such a station cannot be read, or the path names none of its controllers.
    """
    packed = packed_station(path)
    if packed is None:
        return Path(path)
    file, controller = packed
    # Packed stations are rare, and importing the unpacker takes as long as checking a file.
    from rapidsim import pack_and_go  # noqa: PLC0415

    with _unpacking(file, pack_and_go.PackedStationError):
        return pack_and_go.unpacked_backup(input_bytes(file), str(file), controller)


def single_programs(path: str) -> tuple[str, ...]:
    """Return the programs of a path: itself, or each controller of a packed station with several.

    Raises:
        InputError: If such a station cannot be read.
    """
    packed = packed_station(path)
    if packed is None or packed[1] is not None:
        return (path,)
    from rapidsim import pack_and_go  # noqa: PLC0415

    with _unpacking(packed[0], pack_and_go.PackedStationError):
        names = pack_and_go.controllers(input_bytes(packed[0]))
    return tuple(f"{path}!{name}" for name in names) if len(names) > 1 else (path,)


@contextmanager
def _unpacking(file: Path, refused: type[ValueError]) -> Iterator[None]:
    """Convert errors of an archive to errors of the user's input."""
    try:
        yield
    except refused as error:
        raise InputError(f"{file} {error}") from None
    except OSError as error:
        raise InputError(f"{file} cannot be unpacked: {error.strerror}") from None


def packed_station(path: str) -> tuple[Path, str | None] | None:
    """Return the archive of a path and the controller it names; None if it is no archive."""
    match = _PACKED.fullmatch(path)
    if match is None or Path(path).is_dir():
        return None
    return Path(match["file"]), match["controller"]


def named_file(path: str) -> Path:
    """Return the file or folder on disk: for a packed station, its archive."""
    packed = packed_station(path)
    return Path(path) if packed is None else packed[0]


def _display_name(module: Path) -> str:
    """Name of a module for display: its path in the archive if it comes from one."""
    unpacking = sys.modules.get("rapidsim.pack_and_go")
    return str(module) if unpacking is None else str(unpacking.shown_name(module))


def neighbours(path: str) -> tuple[str, ...]:
    """Names of the other modules in a module's folder, which it may need; empty for other paths."""
    file = Path(path)
    if path == "-" or not file.is_file() or file.suffix.lower() == ".pgf":
        return ()
    return tuple(entry.name for entry in _modules_of(file.parent) if entry.name != file.name)


def _read(modules: Iterable[str | Path]) -> TaskFiles:
    """Read the modules of one task, each once.

    Raises:
        InputError: If a module cannot be read, or all are encoded for a controller.
    """
    read: dict[object, SourceFile] = {}
    encoded: dict[object, str] = {}
    for module in modules:
        key = module if isinstance(module, str) else os.path.realpath(module)
        if key in read or key in encoded:
            continue
        data = standard_input() if isinstance(module, str) else input_bytes(module)
        name = STANDARD_INPUT if isinstance(module, str) else _display_name(module)
        if is_encoded(data):
            encoded[key] = name
        else:
            read[key] = _source_file(name, data)
    if encoded and not read:
        raise InputError(f"{next(iter(encoded.values()))} is encoded, or not a RAPID file at all")
    unseen = tuple(f"{Path(name).name} (encoded)" for name in encoded.values())
    return TaskFiles(None, tuple(read.values()), unseen)


def _source_file(name: str, data: bytes) -> SourceFile:
    file = SourceFile(name, *decode(data))
    # Modules may have other suffixes, but then they must look like modules.
    is_named_so = name == STANDARD_INPUT or Path(name).suffix.lower() in MODULE_SUFFIXES
    if not is_named_so and not _MODULE_HEADER.search(file.text):
        raise InputError(
            f"{name} is not a RAPID file: no MODULE begins in it",
            f"RAPID modules end in {', '.join(MODULE_SUFFIXES)}",
        )
    return file


def _modules_of(folder: Path) -> list[Path]:
    return [
        entry
        for entry in entries_of(folder)
        if entry.suffix.lower() in MODULE_SUFFIXES and entry.exists() and not entry.is_dir()
    ]


def _in_folder(folder: Path, *, may_be_empty: bool = False) -> list[Path]:
    """Return the modules of a folder; a task folder of a backup has them in PROGMOD and SYSMOD."""
    rapid = [e for e in entries_of(folder) if e.name.upper() == "RAPID" and e.is_dir()]
    modules = _modules_below(folder) or [m for entry in rapid for m in _modules_below(entry)]
    if modules or may_be_empty:
        return modules
    below = list(islice(_programs_below(folder), _MOST_NAMED))
    raise InputError(
        f"{folder} holds no RAPID file ({', '.join(MODULE_SUFFIXES)})",
        f"there are some in {', '.join(below)}: name one of these folders" if below else None,
    )


def _programs_below(folder: Path) -> Iterator[str]:
    """Yield the nearest subfolders that a user may name: with modules, or with a folder RAPID."""
    level = [folder]
    for _ in range(_DEEPEST):
        level = [e for one in level for e in entries_of(one) if e.is_dir() and not e.is_symlink()]
        deeper = []
        for one in level[:_MOST_FOLDERS]:
            if _modules_below(one) or (one / "RAPID").is_dir():
                yield one.relative_to(folder).as_posix()
            else:
                deeper.append(one)
        level = deeper


def _modules_below(folder: Path) -> list[Path]:
    modules = _modules_of(folder)
    for entry in entries_of(folder):
        if entry.name.upper() in _IN_TASK and entry.is_dir():
            modules += _modules_of(entry)
    return modules


def _in_task_folder(folder: Path) -> tuple[list[Path], tuple[str, ...], tuple[str, ...]]:
    """Find the modules of a task in a backup.

    Returns:
        Modules that the controller loads, files that it does not load, and missing modules.
    """
    modules = {one.relative_to(folder).as_posix().lower(): one for one in _in_folder(folder)}
    task = _backinfo(folder).get(folder.name.lower())
    listed = () if task is None else task.modules
    loaded = [one for path, one in modules.items() if path in listed]
    if not loaded:
        return list(modules.values()), (), ()
    missing = (path.rpartition("/")[2] for path in listed if path not in modules)
    left_out = (one.name for path, one in modules.items() if path not in listed)
    return loaded, tuple(left_out), tuple(f"{name} (not in the backup)" for name in missing)


def _backinfo(folder: Path) -> Mapping[str, ListedTask]:
    """Return the tasks that the backup of a task folder lists; empty if it lists none."""
    root = folder.parent.parent
    for entry in entries_of(root):
        file = entry / "backinfo.txt"
        if entry.name.upper() == "BACKINFO" and file.is_file():
            return listed_tasks(decode(input_bytes(require_inside([file], [root])[0]))[0])
    return {}


def _in_program_file(path: Path) -> tuple[list[Path], list[str]]:
    """Find the modules that a `.pgf` lists, which are in the same folder.

    Returns:
        The existing modules, and the names of the others with the reason.
    """
    names = module_names(path, input_bytes(path))
    if not names:
        raise InputError(f"{path} lists no module")
    beside = {entry.name.lower(): entry for entry in entries_of(path.parent)}
    modules: list[Path] = []
    missing: list[str] = []
    for name in names:
        # The file is not trusted: it may only name files of the same folder.
        if "\\" in name or len(PurePosixPath(name).parts) != 1 or name == "..":
            raise InputError(f"{path} lists `{name}`, which is not in the same folder")
        if name.lower() in beside:
            modules.append(beside[name.lower()])
        else:
            missing.append(f"{name} (listed by {path.name}, not next to it)")
    if not modules:
        raise InputError(
            f"{path} lists {names[0]}, which is missing", did_you_mean(names[0], beside)
        )
    return modules, missing


def module_names(path: Path, data: bytes) -> list[str]:
    """Return the text of the Module elements; document types are rejected, so no entity expands."""
    parser = expat.ParserCreate()
    parser.buffer_text = True
    names: list[str] = []
    inside = False

    def start(tag: str, _: object) -> None:
        nonlocal inside
        inside = tag.lower() == "module"
        if inside:
            names.append("")

    def end(_: str) -> None:
        nonlocal inside
        inside = False

    def text(characters: str) -> None:
        if inside:
            names[-1] += characters

    def document_type(*_: object) -> None:
        raise InputError(f"{path} declares a document type, which program files never do")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    parser.StartDoctypeDeclHandler = document_type
    try:
        parser.Parse(data, True)
    except (expat.ExpatError, LookupError, ValueError) as error:
        if _MODULE_HEADER.search(decode(data)[0]):
            raise InputError(
                f"{path} is not a program file, which lists modules, but a module itself",
                "give it the ending .mod",
            ) from error
        raise InputError(f"{path} is not a program file: {error}") from error
    return [name.strip() for name in names if name.strip()]
