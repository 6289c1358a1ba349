r"""Text tables: texts of a program in files, one file per language, found by name and number.

Format of a file; other formats are rejected:

    # A comment.
    deburring::
    1:
    Part 1 is not in position
    2: #no part
    ""

Tables belong to the controller, so all tasks see them, and none can be removed.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TextTabInstall",
"TextTabFreeToUse", "TextTabGet", "TextGet"; the format is that of ABB's own text definition files.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rapidsim.files import decode
from rapidsim.language.annotations import Bool, Num, String
from rapidsim.language.controller import Controller
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_FILEACC, ERR_TXTNOEXIST, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode
from rapidsim.language.texts import Texts
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.library.table import routine, table

LARGEST_FILE = 1_000_000
"""Bytes of a file of texts."""
EMPTY = '""'
"""Notation of an empty text in a file."""
_TABLE = re.compile(r"(\w+)::\s*(?:#.*)?")
_INDEX = re.compile(r"(\d+):\s*(?:#.*)?")


def text_tab_install(controller: Controller, file: String) -> None:
    """Read a file of texts and install its tables."""
    opened = controller.files.open_file(file, FileMode.READ)
    data = opened.read(LARGEST_FILE + 1)
    opened.close()
    if len(data) > LARGEST_FILE:
        raise rapid_error(ERR_FILEACC, f"{file} has more than {LARGEST_FILE:g} bytes")
    tables = _read_tables(file, decode(data)[0])
    for name in tables:
        if controller.texts.text_table(name) is not None:
            raise rapid_error(
                ERR_ARGVALERR,
                f"{file}: there is a text table {name} already; ask TextTabFreeToUse first",
            )
    for name, texts in tables.items():
        controller.texts.install_texts(name, texts)


def text_tab_free_to_use(controller: Texts, table_name: String) -> Bool:
    """Whether no text table of that name is installed."""
    return controller.text_table(table_name) is None


def text_tab_get(controller: Texts, table_name: String) -> Num:
    """The number of a text table."""
    number = controller.text_table(table_name)
    if number is None:
        raise rapid_error(ERR_TXTNOEXIST, f"no text table is named {table_name}")
    return float(number)


def text_get(controller: Texts, table: Num, index: Num) -> String:
    """A text of a table."""
    text = controller.table_text(table, index)
    if text is None:
        raise rapid_error(ERR_TXTNOEXIST, f"there is no text {index:g} in text table {table:g}")
    return text


def _read_tables(file: str, text: str) -> Mapping[str, Mapping[int, str]]:
    """Tables of a file by name, each with its texts by index."""
    tables: dict[str, dict[int, str]] = {}
    texts: dict[int, str] | None = None
    index: int | None = None
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("#") or not line.strip():
            continue
        if match := _TABLE.fullmatch(line):
            texts, index = tables.setdefault(match[1], {}), None
        elif texts is None:
            raise _unreadable(file, number, "a table begins with a line `name::`")
        elif match := _INDEX.fullmatch(line):
            index = int(match[1])
            if index in texts:
                raise _unreadable(file, number, f"text {index} is here a second time")
        elif index is None or index in texts:
            raise _unreadable(file, number, "each text is one line below a line with its number")
        elif len(line) > MAX_STRING:
            problem = f"the text has {len(line)} characters and a string at most {MAX_STRING}"
            raise _unreadable(file, number, problem)
        else:
            texts[index] = "" if line == EMPTY else line
    if not tables:
        raise _unreadable(file, 1, "a table begins with a line `name::`")
    return tables


def _unreadable(file: str, line: int, problem: str) -> RapidError:
    return rapid_error(ERR_FILEACC, f"{file}:{line}: {problem}")


TEXT_TABLES = table(
    routine("TextTabInstall", text_tab_install),
    routine("TextTabFreeToUse", text_tab_free_to_use),
    routine("TextTabGet", text_tab_get),
    routine("TextGet", text_get),
)
