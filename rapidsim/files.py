"""Find and read RAPID source files: what the user named becomes text, or an `InputError` says why.

Files come from controllers and from careless tools, so reading never fails on their bytes. What a
path may be: a module, a `.pgf` program file, a folder, a controller backup, a `.rspag`, or `-`.
A link that leads out of a folder is refused: a repository that is checked is not trusted.
"""

from __future__ import annotations

import difflib
import os
import re
import stat
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import BinaryIO
from xml.parsers import expat

from rapidsim.backinfo import ListedTask, listed_tasks
from rapidsim.values import dataclass

MODULE_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")
PACKED_SUFFIX = ".rspag"
STANDARD_INPUT = "<stdin>"
_IN_TASK = ("PROGMOD", "SYSMOD")
"""Folders in the folder of a task that hold its modules."""

_STEERING = bytes({*range(32), 127} - set(b"\t\n\v\f\r\x1a\x1b"))
"""What no text holds."""
_LOOKED_AT = 4096
_FEW_STRAY = 16
_STRAY_SHARE = 0.03
"""Text has a few such bytes at most; in a code every eighth is one."""

# Windows tools write code page 1252; its five unassigned bytes exist in ISO 8859-1 only, which
# takes every byte. Byte order marks come first: they are proof, the rest is a guess.
_BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8"),
    (b"\xff\xfe", "utf-16-le"),
    (b"\xfe\xff", "utf-16-be"),
)
_ENCODINGS = ("utf-8", "cp1252")
_LAST_RESORT = "latin-1"

MOST_BYTES = 200_000_000
"""No file that is read is larger: a million moves with their targets have 140 MB."""

# Never wait for a pipe; Windows has none.
_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)

_AS_NEAR = 0.1
"""Names whose likeness to a given one differs by less are equally near."""

_MODULE_HEADER = re.compile(r"^\s*(MODULE\s+\w|%%%)", re.IGNORECASE | re.MULTILINE)


class InputError(Exception):
    """Unusable input of the user: a path, a name, a value. Never a defect of rapidsim."""

    def __init__(self, message: str, help: str | None = None) -> None:
        """Say what is wrong, and the cure if it is known, in one line each."""
        super().__init__(message)
        self.message = message
        self.help = help


@dataclass(frozen=True, slots=True)
class SourceFile:
    """The text of one file."""

    name: str
    """As the user named it, or below the folder the user named."""
    text: str
    encoding: str
    """What the bytes were taken for."""


@dataclass(frozen=True, slots=True)
class TaskFiles:
    """The modules of one task, in a fixed order."""

    name: str | None
    """The folder of the task in a backup, such as `TASK1`; None where nothing names it."""
    files: tuple[SourceFile, ...]
    unseen: tuple[str, ...] = ()
    """Modules that it has and that cannot be read here, each with the reason in words."""
    left_out: tuple[str, ...] = ()
    """Files beside them in a backup that the controller does not load."""
    refers_late: bool = False
    """Whether its controller loads it with references that nothing declares."""


def read_tasks(paths: Sequence[str], rooms: Sequence[Path] = ()) -> tuple[TaskFiles, ...]:
    """Read everything the user named.

    Args:
        paths: Files, `.pgf` files, folders, or `-`. Together they are one task, except that each
            task folder of a controller backup is a task of its own.
        rooms: Folders into which links may lead, besides those among the paths.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID.
    """
    modules: list[str | Path] = []
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
            modules += require_inside(_in_folder(found), (found, *rooms))
        elif found.suffix.lower() == ".pgf":
            modules += require_inside(_in_program_file(found), (found.parent, *rooms))
        else:
            modules.append(found)
    if modules:
        tasks.insert(0, _read(modules))
    if not tasks:
        raise InputError("no RAPID file was named", "name a module, a .pgf file or a folder")
    return tuple(tasks)


def named_tasks(tasks: Sequence[TaskFiles], first: str) -> tuple[TaskFiles, ...]:
    """Tasks with the names they have on a controller: one is `first`, several are numbered."""
    if len(tasks) == 1:
        return (replace(tasks[0], name=first),)
    return tuple(replace(task, name=f"T_ROB{number}") for number, task in enumerate(tasks, 1))


def task_folders(folder: Path) -> tuple[Path, ...]:
    """TASK1, TASK2 ... of a backup's RAPID folder, named itself or by the folder above.

    TASK0 holds what the system installs in every task, and is none. Beside a folder SYSPAR, the
    folders in RAPID may have the names of the tasks.
    """
    below = [entry for entry in _entries(folder) if entry.name.upper() == "RAPID"]
    for entry in (folder, *below):
        if not entry.is_dir():
            continue
        tasks = [e for e in _entries(entry) if re.fullmatch(r"TASK[1-9]\d*", e.name.upper())]
        if tasks:
            return tuple(sorted(tasks, key=lambda e: int(e.name[4:])))
        is_rapid = entry.name.upper() == "RAPID"
        if is_rapid and any(e.name.upper() == "SYSPAR" for e in _entries(entry.parent)):
            return tuple(e for e in _entries(entry) if _is_task_by_name(e))
    return ()


def _is_task_by_name(folder: Path) -> bool:
    """Whether a folder in RAPID is a task: it has modules, and is no task's own folder."""
    if not folder.is_dir() or folder.name.upper() in (*_IN_TASK, "TASK0"):
        return False
    return bool(_modules_below(folder))


def backup_folders(paths: Iterable[str]) -> tuple[Path, ...]:
    """The task folders of the first controller backup among some paths; none without one."""
    for path in paths:
        folder = opened(path)
        folders = task_folders(folder) if path != "-" and folder.is_dir() else ()
        if folders:
            return folders
    return ()


def opened(path: str) -> Path:
    """What a path stands for: itself, or the backup that a packed station (`.rspag`) holds.

    Raises:
        InputError: If such a station cannot be read, or has not one controller.
    """
    file = Path(path)
    if file.suffix.lower() != PACKED_SUFFIX or file.is_dir():
        return file
    # Few stations are packed, and what unpacks them takes as long to load as a file to check.
    from rapidsim import pack_and_go  # noqa: PLC0415

    try:
        return pack_and_go.unpacked_backup(input_bytes(file), file.stem)
    except pack_and_go.PackedStationError as error:
        raise InputError(f"{file} {error}") from None
    except OSError as error:
        raise InputError(f"{file} cannot be unpacked: {error.strerror}") from None


def neighbours(path: str) -> tuple[str, ...]:
    """Names of the modules beside a module, which it may need; none beside what is no file."""
    file = Path(path)
    if path == "-" or not file.is_file() or file.suffix.lower() == ".pgf":
        return ()
    return tuple(entry.name for entry in _modules_of(file.parent) if entry.name != file.name)


def input_bytes(file: Path) -> bytes:
    """All of a file that the user named; the one place where such a file is opened.

    Raises:
        InputError: If it is missing, unreadable, too large, or no file but a folder, pipe or
            device.
    """
    try:
        mode = file.stat().st_mode
        if not stat.S_ISREG(mode):
            kind = "folder" if stat.S_ISDIR(mode) else "pipe" if stat.S_ISFIFO(mode) else "device"
            raise InputError(f"{file} is no file but a {kind}")
        with os.fdopen(os.open(file, os.O_RDONLY | _NEVER_WAIT), "rb") as stream:
            return _bounded(stream, str(file))
    except OSError as error:
        raise unreadable(file, error) from error
    except ValueError as error:
        raise InputError(f"{str(file)!r} is not a file name") from error


def standard_input() -> bytes:
    """All of standard input.

    Raises:
        InputError: If it is closed or too long.
    """
    if sys.stdin is None:
        raise InputError("standard input is closed")
    return _bounded(sys.stdin.buffer, "standard input")


def input_text(file: Path) -> str:
    """The text of a file that must be UTF-8; a byte order mark is taken off.

    Raises:
        InputError: If it is something else; see `input_bytes`.
    """
    try:
        return input_bytes(file).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        reason = f"{error.reason} at byte {error.start}"
        raise InputError(f"{file} is not UTF-8 text: {reason}") from error


def require_inside(files: Sequence[Path], rooms: Iterable[Path]) -> Sequence[Path]:
    """The files, if none of them leads out of all rooms, through `..`, a link or a full path.

    A repository that is checked must not have other files of the computer read and shown.

    Raises:
        InputError: If one does.
    """
    rooms = tuple(rooms)
    held = [os.path.realpath(room) for room in rooms]
    for file in files:
        place = Path(os.path.realpath(file))
        if not any(place.is_relative_to(room) for room in held):
            raise InputError(
                f"{file} leads out of {rooms[0]}, to {place}",
                "what may be read from elsewhere is named on the command line itself",
            )
    return files


def decode(data: bytes) -> tuple[str, str]:
    """Text of a file's bytes and the encoding they were taken for; takes any bytes."""
    for mark, encoding in _BYTE_ORDER_MARKS:
        if data.startswith(mark):
            return data[len(mark) :].decode(encoding, errors="replace"), encoding
    for encoding in _ENCODINGS:
        try:
            return data.decode(encoding), encoding
        except UnicodeDecodeError:
            continue
    return data.decode(_LAST_RESORT), _LAST_RESORT


def did_you_mean(name: str, known: Iterable[str]) -> str | None:
    """The help line for a name that is not known, if something known is near."""
    folded = {candidate.lower(): candidate for candidate in known}
    near = difflib.get_close_matches(name.lower(), folded, n=3, cutoff=0.6)
    if not near:
        return None
    likeness = difflib.SequenceMatcher(b=name.lower())
    ratios = []
    for candidate in near:
        likeness.set_seq1(candidate)
        ratios.append(likeness.ratio())
    # A slip of the finger is nearer to what was meant than to anything else.
    meant = [one for one, ratio in zip(near, ratios, strict=True) if ratio > ratios[0] - _AS_NEAR]
    return f"did you mean {' or '.join(f'`{folded[candidate]}`' for candidate in meant)}?"


def _read(modules: Iterable[str | Path]) -> TaskFiles:
    """Modules of one task, each once.

    Raises:
        InputError: If one cannot be read, or none of them by anybody but a controller.
    """
    read: dict[object, SourceFile] = {}
    encoded: dict[object, str] = {}
    for module in modules:
        key = module if isinstance(module, str) else os.path.realpath(module)
        if key in read or key in encoded:
            continue
        data = standard_input() if isinstance(module, str) else input_bytes(module)
        name = STANDARD_INPUT if isinstance(module, str) else str(module)
        if _is_encoded(data):
            encoded[key] = name
        else:
            read[key] = _source_file(name, data)
    if encoded and not read:
        raise InputError(f"{next(iter(encoded.values()))} is encoded, or not a RAPID file at all")
    unseen = tuple(f"{Path(name).name} (encoded)" for name in encoded.values())
    return TaskFiles(None, tuple(read.values()), unseen)


def _is_encoded(data: bytes) -> bool:
    """Whether bytes are no text: controllers write modules that nobody may see in a code."""
    if any(data.startswith(mark) for mark, _ in _BYTE_ORDER_MARKS):
        return False
    head = data[:_LOOKED_AT]
    steering = len(head) - len(head.translate(None, _STEERING))
    return steering > _FEW_STRAY and steering > _STRAY_SHARE * len(head)


def _source_file(name: str, data: bytes) -> SourceFile:
    file = SourceFile(name, *decode(data))
    # Modules travel under other names too, but then they must look like one.
    is_named_so = name == STANDARD_INPUT or Path(name).suffix.lower() in MODULE_SUFFIXES
    if not is_named_so and not _MODULE_HEADER.search(file.text):
        raise InputError(
            f"{name} is not a RAPID file: no MODULE begins in it",
            f"RAPID modules end in {', '.join(MODULE_SUFFIXES)}",
        )
    return file


def unreadable(path: Path, error: OSError) -> InputError:
    """The mistake that a file could not be read, with the file that was meant if it is known."""
    if isinstance(error, FileNotFoundError):
        return InputError(f"{path} does not exist", _near_file(path))
    return InputError(f"{path} cannot be read: {error.strerror or error}")


def _bounded(stream: BinaryIO, name: str) -> bytes:
    """All bytes of a stream, refused if there is no end of them."""
    data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise InputError(f"{name} has more than {MOST_BYTES // 10**6} MB, which is not read")
    return data


def _near_file(path: Path) -> str | None:
    """The help line with the file beside it that was meant, if one is near.

    Compared without the suffix, which makes all modules alike.
    """
    try:
        names = sorted(entry.name for entry in path.parent.iterdir())
    except OSError:
        return None
    alike = {Path(one).stem: one for one in names if one.lower().endswith(path.suffix.lower())}
    near = did_you_mean(path.stem, alike)
    return near and re.sub("`(.*?)`", lambda stem: f"`{alike[stem[1]]}`", near)


def _entries(folder: Path) -> list[Path]:
    """What a folder holds; sorted without case, so that the order is that of any file system."""
    try:
        return sorted(folder.iterdir(), key=lambda entry: (entry.name.lower(), entry.name))
    except OSError as error:
        raise unreadable(folder, error) from error


def _modules_of(folder: Path) -> list[Path]:
    return [
        entry
        for entry in _entries(folder)
        if entry.suffix.lower() in MODULE_SUFFIXES and entry.exists() and not entry.is_dir()
    ]


def _in_folder(folder: Path) -> list[Path]:
    """The modules of a folder; a task folder of a backup keeps them in PROGMOD and SYSMOD."""
    rapid = [e for e in _entries(folder) if e.name.upper() == "RAPID" and e.is_dir()]
    modules = _modules_below(folder) or [m for entry in rapid for m in _modules_below(entry)]
    if modules:
        return modules
    below = [entry.name for entry in _entries(folder) if entry.is_dir() and _modules_of(entry)]
    raise InputError(
        f"{folder} holds no RAPID file ({', '.join(MODULE_SUFFIXES)})",
        f"there are some in {', '.join(below[:5])}: name one of these folders" if below else None,
    )


def _modules_below(folder: Path) -> list[Path]:
    modules = _modules_of(folder)
    for entry in _entries(folder):
        if entry.name.upper() in _IN_TASK and entry.is_dir():
            modules += _modules_of(entry)
    return modules


def _in_task_folder(folder: Path) -> tuple[list[Path], tuple[str, ...], tuple[str, ...]]:
    """The modules of a task of a backup.

    Returns:
        Those that the controller loads, files that it does not, and modules that are not there.
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
    """What the backup of a task folder says of its tasks; nothing where it does not say."""
    root = folder.parent.parent
    for entry in _entries(root):
        file = entry / "backinfo.txt"
        if entry.name.upper() == "BACKINFO" and file.is_file():
            return listed_tasks(decode(input_bytes(require_inside([file], [root])[0]))[0])
    return {}


def _in_program_file(path: Path) -> list[Path]:
    """The modules a `.pgf` lists; they lie beside it."""
    names = module_names(path, input_bytes(path))
    if not names:
        raise InputError(f"{path} lists no module")
    beside = {entry.name.lower(): entry for entry in _entries(path.parent)}
    modules = []
    for name in names:
        # The file is not trusted: it names neighbours, never places elsewhere.
        if "\\" in name or len(PurePosixPath(name).parts) != 1 or name == "..":
            raise InputError(f"{path} lists `{name}`, which is not in the same folder")
        if name.lower() not in beside:
            raise InputError(f"{path} lists {name}, which is missing", did_you_mean(name, beside))
        modules.append(beside[name.lower()])
    return modules


def module_names(path: Path, data: bytes) -> list[str]:
    """Text of the Module elements. A document type is refused, so no entity is ever expanded."""
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
        raise InputError(f"{path} is not a program file: {error}") from error
    return [name.strip() for name in names if name.strip()]


def seen_from_here(path: Path) -> Path:
    """A path below the working directory as the user would write it; others unchanged."""
    here = Path.cwd().resolve()
    return path.relative_to(here) if path.is_relative_to(here) else path
