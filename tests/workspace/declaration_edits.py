"""Random edits of what modules declare."""

from __future__ import annotations

import random
import re

from rapidsim.workspace.changes import TextChange

_DATA = re.compile(r"^[ \t]*(?:LOCAL |TASK )?(?:VAR|PERS|CONST) +(\w+) +(\w+)[^;\n]*;", re.M | re.I)
_HEADER = re.compile(r"^[ \t]*(?:LOCAL )?(?:PROC|FUNC +\w+|TRAP) +(\w+)", re.M | re.I)
_ROUTINE = re.compile(r"^[ \t]*(?:LOCAL )?PROC\b.*?^[ \t]*ENDPROC\b", re.M | re.S | re.I)
_PARAMETERS = re.compile(r"^[ \t]*(?:LOCAL )?(?:PROC|FUNC +\w+) +\w+ *(\()", re.M | re.I)
_CLOSER = re.compile(r"^[ \t]*END(?:IF|WHILE|FOR|TEST)\b *;?", re.M | re.I)
_WORD = re.compile(r"[A-Za-z_]\w*")
_LINES = (
    "  VAR num {};",
    "  PERS num {}:=1;",
    "  CONST num {}:={}+1;",
    "  LOCAL VAR num {};",
    "  VAR bool {};",
    "  CONST num {}:=2;",
    "  VAR num {}{{3}};",
    "  VAR num {}{{{}}};",
    "  VAR undeclared {};",
    "  RECORD {}\n    num x;\n  ENDRECORD",
    "  PROC {}()\n    {};\n  ENDPROC",
    "  LOCAL PROC {}(num {})\n    IF TRUE THEN\n    ENDIF\n  ENDPROC",
    "  FUNC num {}(num x)\n    RETURN {}+x;\n  ENDFUNC",
    "  TRAP {}\n  ENDTRAP",
    "  ! {}",
    "",
)


def declaration_edit(rng: random.Random, text: str) -> TextChange | None:
    """An item added, removed or renamed, a header changed, or a block that is not closed."""
    data, headers = list(_DATA.finditer(text)), list(_HEADER.finditer(text))
    items = [*data, *headers]
    if not items:
        return None
    match rng.randrange(9):
        case 0 | 1:
            return _new_item(rng, text, rng.choice(items))
        case 2 | 3:
            item = rng.choice(items)
            group = item.lastindex or 1
            return TextChange(item.start(group), item.end(group), _name(rng, text))
        case 4 if data:
            item = rng.choice(data)
            return TextChange(item.start(), item.end() + rng.randrange(2), "")
        case 5 if data:
            item = rng.choice(data)
            return TextChange(item.start(1), item.end(1), rng.choice(["num", "bool", "nothing"]))
        case 6 if found := list(_PARAMETERS.finditer(text)):
            item = rng.choice(found)
            comma = "" if text[item.end(1) :].lstrip().startswith(")") else ","
            return TextChange(item.end(1), item.end(1), f"num {_name(rng, text)}{comma}")
        case 7 if found := list(_CLOSER.finditer(text)):
            item = rng.choice(found)
            return TextChange(item.start(), item.end(), "")
        case 8 if found := list(_ROUTINE.finditer(text)):
            item = rng.choice(found)
            return TextChange(item.start(), item.end(), "")
        case _:
            pass
    at = rng.choice(items).start()
    return TextChange(at, at, rng.choice(["LOCAL ", "!", " ", "\n", "VAR "]))


def _new_item(rng: random.Random, text: str, item: re.Match[str]) -> TextChange:
    line = rng.choice(_LINES).format(*(_name(rng, text) for _ in range(2)))
    if rng.random() < 0.5:
        return TextChange(item.start(), item.start(), f"{line}\n")
    end = text.find("\n", item.end())
    return TextChange(end, end, f"\n{line}") if end >= 0 else TextChange(0, 0, "")


def _name(rng: random.Random, text: str) -> str:
    """A name of the text, one like it, or another."""
    word = rng.choice(_WORD.findall(text))
    return str(rng.choice([word, f"{word}x", word[:-1] or "a", f"new{rng.randrange(9)}"]))
