r"""Files of the home folder: opening, writing, reading.

Text is bytes in ISO 8859-1; a line ends in a line feed. A string holds at most 80 characters, so a
longer line is read in pieces.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Open", "Write",
"ReadStr", "ReadNum", "WriteStrBin".
"""

from __future__ import annotations

import math

from rapidsim.language.annotations import Bool, Dnum, InOut, IoDev, Num, String, Switch, Var
from rapidsim.language.controller import FidelityReporter
from rapidsim.language.data import Orient, Pos
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_FILEACC,
    ERR_FILEOPEN,
    ERR_RCVDATA,
    rapid_error,
)
from rapidsim.language.files import FileMode, Files, OpenFile
from rapidsim.language.reference import Reference
from rapidsim.language.single_precision import single
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.library.operator import option_text
from rapidsim.library.table import routine, table
from rapidsim.library.text import parsed_number
from rapidsim.library.traits import Trait

_ENCODING = "iso-8859-1"
END_OF_FILE = "EOF"
"""Return value of ReadStr at the end of a file: the constant EOF."""
REMAIN = "REMAIN"
r"""\Status of ReadStr for a line longer than a string.

Source: ABB's own RobotWare 7 packages compare it with this value.
"""
END_OF_NUMBERS = single(9.998e36)
"""Return value of ReadNum at the end of a file: the constant EOF_NUM."""
END_OF_BYTES = -1.0
"""Return value of ReadBin at the end of a file: the constant EOF_BIN."""


def open_(
    controller: Files,
    object_: String,
    io_device: Var[IoDev],
    *,
    file: String | None = None,
    read: Switch = False,
    write: Switch = False,
    append: Switch = False,
    bin_: Switch = False,
) -> None:
    r"""Open a file: for writing by default, for appending if binary, or as a switch selects.

    Apart from that, binary and text files do not differ: the write instructions decide the format.
    """
    if io_device.value is not None:
        raise rapid_error(ERR_FILEOPEN, "the device is open already; Close it first")
    path = joined_path(object_, file)
    appends = append or (bin_ and not write)
    mode = FileMode.READ if read else FileMode.APPEND if appends else FileMode.WRITE
    io_device.value = controller.open_file(path, mode)


def joined_path(path: str, file: str | None) -> str:
    r"""Path with the part that `\File` adds."""
    return path if file is None else f"{path.rstrip('/')}/{file}"


def close(io_device: Var[IoDev]) -> None:
    """Close a file; a file that is not open is no error."""
    if io_device.value is not None:
        io_device.value.close()
        io_device.value = None


def rewind(io_device: Var[IoDev]) -> None:
    """Rewind to the beginning of a file."""
    opened_device(io_device).rewind()


def clear_io_buff(io_device: Var[IoDev]) -> None:
    """Discard the input buffer of a serial line; has no effect on a file."""
    opened_device(io_device)


def write(
    io_device: Var[IoDev],
    string: String,
    *,
    num: Num | None = None,
    bool_: Bool | None = None,
    pos: Pos | None = None,
    orient: Orient | None = None,
    dnum: Dnum | None = None,
    no_new_line: Switch = False,
) -> None:
    """Write a text and a value, and end the line."""
    text = string + option_text(num, bool_, pos, orient, dnum)
    _write(io_device, text if no_new_line else text + "\n")


def write_bin(io_device: Var[IoDev], buffer: list[Num], n_char: Num) -> None:
    """Write the first bytes of an array of numbers."""
    count = int(n_char)
    if not 0 <= count <= len(buffer):
        raise rapid_error(ERR_ARGVALERR, f"{count} bytes of an array with {len(buffer)} elements")
    for value in buffer[:count]:
        if not (0 <= value <= 255 and value == math.floor(value)):
            raise rapid_error(ERR_ARGVALERR, f"{value:.7g} is not a byte; bytes are 0..255")
    opened_device(io_device).write(bytes(int(value) for value in buffer[:count]))


def write_str_bin(io_device: Var[IoDev], str_: String) -> None:
    """Write a text without ending the line."""
    _write(io_device, str_)


def read_str(
    controller: FidelityReporter,
    io_device: Var[IoDev],
    *,
    delim: String | None = None,
    remove_cr: Switch = False,
    discard_headers: Switch = False,
    time: Num | None = None,
    line: Num | None = None,
    status: InOut[String] | None = None,
) -> String:
    r"""The text up to the end of the line or a delimiter; EOF at the end of the file.

    A string holds 80 characters; the next call reads the rest of a longer line, and \Status is
    then "REMAIN". No source documents its other value: it is "", which the run reports. \Time
    limits a wait, and a file never causes one.
    """
    del time
    file = opened_device(io_device)
    text = _text_from(file, delim, line, remove_cr=remove_cr, discard_headers=discard_headers)
    if status is not None:
        status.value = REMAIN if len(text) == MAX_STRING else ""
        if not status.value:
            controller.not_simulated(r"ReadStr \Status", "empty where nothing of the line remains")
    return text


def _text_from(
    file: OpenFile,
    delim: str | None,
    line: float | None,
    *,
    remove_cr: bool = False,
    discard_headers: bool = False,
) -> str:
    if line is not None:
        for _ in range(max(0, int(line) - 1)):
            file.read_line()
    end = b"\n" + (b"" if delim is None else delim.encode(_ENCODING, "replace"))
    text = bytearray()
    while len(text) < MAX_STRING:
        byte = file.read(1)
        if not byte and not text:
            return END_OF_FILE
        if not byte or byte in end:
            if discard_headers and byte and not text:
                continue
            break
        if byte != b"\r" or not remove_cr:
            text += byte
    return text.decode(_ENCODING)


def read_num(
    io_device: Var[IoDev],
    *,
    delim: String | None = None,
    time: Num | None = None,
) -> Num:
    """The number on the next line, or before the next delimiter; EOF_NUM at the end of the file."""
    del time
    file = opened_device(io_device)
    text = _text_from(file, delim, None, discard_headers=delim is not None)
    if text == END_OF_FILE:
        return END_OF_NUMBERS
    value = parsed_number(text)
    if value is None:
        raise rapid_error(ERR_RCVDATA, f'"{text}" is not a number')
    return value


def read_bin(io_device: Var[IoDev], *, time: Num | None = None) -> Num:
    """The next byte; EOF_BIN at the end of the file."""
    del time
    byte = opened_device(io_device).read(1)
    return float(byte[0]) if byte else END_OF_BYTES


def read_str_bin(io_device: Var[IoDev], no_of_chars: Num, *, time: Num | None = None) -> String:
    """The next characters, at most the number requested; EOF at the end of the file."""
    del time
    count = int(no_of_chars)
    if not 0 <= count <= MAX_STRING:
        raise rapid_error(ERR_ARGVALERR, f"{count} characters; a string holds {MAX_STRING}")
    text = opened_device(io_device).read(count)
    return text.decode(_ENCODING) if text or not count else END_OF_FILE


def opened_device(io_device: Reference[OpenFile | None]) -> OpenFile:
    """Open file of a device.

    Raises:
        RapidError: ERR_FILEACC, if the device is not open.
    """
    if io_device.value is None:
        raise rapid_error(ERR_FILEACC, "the device is not open")
    return io_device.value


def _write(io_device: Reference[OpenFile | None], text: str) -> None:
    opened_device(io_device).write(text.encode(_ENCODING, "replace"))


FILES = table(
    routine("Open", open_, r"Object \File IODevice \Read|\Write|\Append \Bin", does=Trait.OPEN),
    routine("Close", close, does=Trait.CLOSE),
    routine("Rewind", rewind),
    routine("ClearIOBuff", clear_io_buff),
    routine("Write", write, r"IODevice String \Num|\Bool|\Pos|\Orient|\Dnum \NoNewLine"),
    routine("WriteBin", write_bin),
    routine("WriteStrBin", write_str_bin, "IODevice Str"),
    routine("ReadStr", read_str, r"IODevice \Delim \RemoveCR \DiscardHeaders \Time \Line \Status"),
    routine("ReadNum", read_num),
    routine("ReadBin", read_bin),
    routine("ReadStrBin", read_str_bin),
)
