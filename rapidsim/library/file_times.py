r"""Modification times of files, including the files of loaded modules.

Times are virtual, as those of CDate: files that exist at the start of a run have the time of that
start, and modification, access and status times are equal. A `num` resolves them to 64 s; \StrDig
and the functions that return a `dnum` resolve them to 1 s.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "FileTime",
"ModTime".
"""

from __future__ import annotations

import math
from datetime import datetime

from rapidsim.language.annotations import Dnum, Num, String, StringDig, Switch, Var
from rapidsim.language.controller import Controller
from rapidsim.language.error_numbers import ERR_FILEACC, ERR_MOD_NOTLOADED, rapid_error
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

_EPOCH = datetime(1970, 1, 1)


def file_time(
    controller: Controller,
    path: String,
    *,
    modify_time: Switch = False,
    access_time: Switch = False,
    stat_c_time: Switch = False,
    str_dig: Var[StringDig] | None = None,
) -> Num:
    """When a file was written, in seconds since 1970."""
    del modify_time, access_time, stat_c_time
    return _seconds(_file_seconds(controller, path), str_dig)


def file_time_dnum(
    controller: Controller,
    path: String,
    *,
    modify_time: Switch = False,
    access_time: Switch = False,
    stat_c_time: Switch = False,
    str_dig: Var[StringDig] | None = None,
) -> Dnum:
    """When a file was written, in seconds since 1970."""
    del modify_time, access_time, stat_c_time
    return _seconds(_file_seconds(controller, path), str_dig)


def mod_time(
    controller: Controller, object_: String, *, str_dig: Var[StringDig] | None = None
) -> Num:
    """When the file of a loaded module was written, in seconds since 1970."""
    return _seconds(_module_seconds(controller, object_), str_dig)


def mod_time_dnum(
    controller: Controller, object_: String, *, str_dig: Var[StringDig] | None = None
) -> Dnum:
    """When the file of a loaded module was written, in seconds since 1970."""
    return _seconds(_module_seconds(controller, object_), str_dig)


def _seconds(seconds: int, digits: Var[StringDig] | None) -> float:
    if digits is not None:
        digits.value = str(seconds)
    return float(seconds)


def _file_seconds(controller: Controller, path: str) -> int:
    written_s = controller.files.written_s(path)
    if written_s is None:
        raise rapid_error(ERR_FILEACC, f"there is no file {path}")
    return _since_epoch(controller, written_s)


def _module_seconds(controller: Controller, name: str) -> int:
    if not controller.modules.has(name):
        raise rapid_error(ERR_MOD_NOTLOADED, f"no module {name} is loaded")
    is_unread = controller.modules.is_unread(name)
    path = None if is_unread else controller.modules.saved(name).loaded_from
    return _since_epoch(controller, 0.0 if path is None else controller.files.loaded_s(path))


def _since_epoch(controller: Controller, at_s: float) -> int:
    clock = controller.clock
    now = round((clock.date_and_time() - _EPOCH).total_seconds())
    return now - math.floor(clock.now()) + math.floor(at_s)


_PATH = r"Path \ModifyTime|\AccessTime|\StatCTime \StrDig"

FILE_TIMES = table(
    routine("FileTime", file_time, _PATH, does=Trait.READ_CELL),
    routine("FileTimeDnum", file_time_dnum, _PATH, does=Trait.READ_CELL),
    routine("ModTime", mod_time, does=Trait.READ_CELL),
    routine("ModTimeDnum", mod_time_dnum, does=Trait.READ_CELL),
)
