r"""Files and folders as a whole: copying, renaming, removing, listing, sizes.

Everything stays inside the home folder. The disk is modelled as one of 1 GB that contains only that
folder, so that free space does not depend on the host computer.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "CopyFile",
"IsFile", "ReadDir", "FSSize" and their like.
"""

from __future__ import annotations

from rapidsim.language.annotations import (
    AnyType,
    ArgumentType,
    Bool,
    Dir,
    InOut,
    IoDev,
    Num,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import DISK_BYTES, Controller
from rapidsim.language.error_numbers import (
    ERR_FILEACC,
    ERR_FILEOPEN,
    ERR_RANYBIN_CHK,
    ERR_RANYBIN_EOF,
    rapid_error,
)
from rapidsim.language.errors import NotAllowed
from rapidsim.language.files import Files
from rapidsim.language.types import NUM
from rapidsim.library.files import opened_device
from rapidsim.library.table import routine, table
from rapidsim.library.text import parsed_value, source_text
from rapidsim.library.traits import Trait

_ENCODING = "iso-8859-1"
_DISK_NOTE = "a disk of 1 GB that holds the home folder alone"


def copy_file(controller: Files, old_path: String, new_path: String) -> None:
    """Copy a file; the target must not exist."""
    controller.copy_file(old_path, new_path)


def rename_file(controller: Files, old_path: String, new_path: String) -> None:
    """Rename or move a file; the target must not exist."""
    controller.rename_file(old_path, new_path)


def remove_file(controller: Files, path: String) -> None:
    """Delete a file."""
    controller.remove_file(path)


def make_dir(controller: Files, path: String) -> None:
    """Create a folder."""
    controller.make_folder(path)


def remove_dir(controller: Files, path: String) -> None:
    """Delete a folder that is empty."""
    controller.remove_folder(path)


def open_dir(controller: Files, dev: Var[Dir], path: String) -> None:
    """Open a folder for ReadDir."""
    if dev.value is not None:
        raise rapid_error(ERR_FILEOPEN, "the folder is open already; CloseDir it first")
    dev.value = [".", "..", *controller.names_in(path)]


def read_dir(dev: Var[Dir], file_name: InOut[String]) -> Bool:
    """The next name in an open folder, `.` and `..` first; FALSE after the last."""
    if dev.value is None:
        raise rapid_error(ERR_FILEACC, "the folder is not open; OpenDir comes first")
    if not dev.value:
        return False
    file_name.value = dev.value.pop(0)
    return True


def close_dir(dev: Var[Dir]) -> None:
    """Close a folder."""
    dev.value = None


def is_file(
    controller: Files,
    path: String,
    *,
    directory: Switch = False,
    fifo: Switch = False,
    reg_file: Switch = False,
    block_spec: Switch = False,
    char_spec: Switch = False,
) -> Bool:
    """Whether a file exists and, if a switch selects a kind, is of that kind."""
    is_regular = controller.file_size(path) is not None
    is_folder = not is_regular and controller.is_folder(path)
    is_there = is_regular or is_folder
    if not (directory or fifo or reg_file or block_spec or char_spec):
        return is_there
    if not is_there:
        raise rapid_error(ERR_FILEACC, f"there is no file {path}, so it has no kind")
    return (is_regular and reg_file) or (is_folder and directory)


def file_size(controller: Files, path: String) -> Num:
    """The size of a file in bytes."""
    size = controller.file_size(path)
    if size is None:
        raise rapid_error(ERR_FILEACC, f"there is no file {path}")
    return float(size)


def fs_size(
    controller: Controller,
    name: String,
    *,
    total: Switch = False,
    free: Switch = False,
    kbyte: Switch = False,
    mbyte: Switch = False,
) -> Num:
    r"""The size of the disk, or the free space on it, in bytes, kB or MB."""
    if not (total or free):
        raise NotAllowed(r"FSSize needs \Total or \Free")
    controller.fidelity.not_simulated("FSSize", _DISK_NOTE)
    used = controller.files.bytes_in(name) if free else 0
    unit = 1024.0 if kbyte else 1024.0**2 if mbyte else 1.0
    return float(int((DISK_BYTES - used) / unit))


def write_any_bin(io_device: Var[IoDev], data: AnyType, *, of: ArgumentType = NUM) -> None:
    """Write data of any value type, in a form that only ReadAnyBin reads."""
    text = f"{of.name} {source_text(data, of)}\n"
    opened_device(io_device).write(text.encode(_ENCODING, "replace"))


def read_any_bin(
    io_device: Var[IoDev],
    data: InOut[AnyType],
    *,
    time: Num | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Read data that WriteAnyBin wrote, into data of the same type."""
    del time
    line = opened_device(io_device).read_line()
    if line is None:
        raise rapid_error(ERR_RANYBIN_EOF, "the file ends before the data")
    name, _, text = line.decode(_ENCODING).partition(" ")
    sample = data if isinstance(data, list) else data.value
    value = parsed_value(text, of, sample) if name == of.name else None
    if value is None:
        raise rapid_error(ERR_RANYBIN_CHK, f"the file holds no {of.name} here, but `{name[:32]}`")
    if isinstance(data, list):
        assert isinstance(value, list)
        data[:] = value
    else:
        data.value = value


FILE_SYSTEM = table(
    routine("CopyFile", copy_file),
    routine("RenameFile", rename_file),
    routine("RemoveFile", remove_file),
    routine("MakeDir", make_dir),
    routine("RemoveDir", remove_dir),
    routine("OpenDir", open_dir),
    routine("ReadDir", read_dir),
    routine("CloseDir", close_dir),
    routine(
        "IsFile",
        is_file,
        r"Path \Directory|\Fifo|\RegFile|\BlockSpec|\CharSpec",
        does=Trait.READ_CELL,
    ),
    routine("FileSize", file_size, does=Trait.READ_CELL),
    routine("FSSize", fs_size, r"Name \Total|\Free \Kbyte \Mbyte", treated_as=_DISK_NOTE),
    routine("WriteAnyBin", write_any_bin),
    routine("ReadAnyBin", read_any_bin),
)
