"""How files come from controllers and careless tools: encodings, line ends, names, program files.

Every file here is made byte by byte; what it means does not depend on how it came.
"""

from pathlib import Path

import pytest

from rapidsim.controller.journal.events import EventKind
from rapidsim.files import InputError
from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.running.run_files import simulate

LINES = (
    "MODULE shop",
    "  ! Größe des Werkstücks",
    "  PROC main()",
    '    TPWrite "Größe";',
    "    TPWrite unknown;",
    "  ENDPROC",
    "ENDMODULE",
)
CORRECT = tuple(line for line in LINES if "unknown" not in line)


def shown(*paths: Path) -> list[str]:
    """What running some files writes on the FlexPendant."""
    run = simulate(paths, robot="irb1600")
    assert not run.diagnostics
    return [event.message for event in run.events if event.kind is EventKind.TEXT]


def written(folder: Path, data: bytes, name: str = "shop.mod") -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "cp1252", "utf-16"])
def test_text_is_the_same_in_every_encoding(tmp_path: Path, encoding: str) -> None:
    assert shown(written(tmp_path, "\n".join(CORRECT).encode(encoding))) == ["Größe"]


def test_bytes_that_are_no_text_are_read(tmp_path: Path) -> None:
    every_byte = bytes(range(0x80, 0x100))
    lines = [b"MODULE bytes", b"! " + every_byte, b"PROC main()", b'TPWrite "ok";', b"ENDPROC"]
    assert shown(written(tmp_path, b"\n".join([*lines, b"ENDMODULE"]))) == ["ok"]


def test_chinese_comments_do_not_stop_a_file(tmp_path: Path) -> None:
    lines = [
        "MODULE chinese",
        "! 位置",
        "PROC main()",
        'TPWrite "ok"; ! 完成',
        "ENDPROC",
        "ENDMODULE",
    ]
    assert shown(written(tmp_path, "\n".join(lines).encode("gb18030"))) == ["ok"]


@pytest.mark.parametrize(
    "end", ["\n", "\r\n", "\r\r\n", "\r"], ids=["LF", "CR LF", "CR CR LF", "CR"]
)
@pytest.mark.parametrize("last", ["", "end"], ids=["cut", "ended"])
def test_lines_are_counted_the_same_with_every_line_end(
    tmp_path: Path, end: str, last: str
) -> None:
    text = end.join(LINES) + (end if last else "")
    everything = check([written(tmp_path, text.encode())]).diagnostics
    # That a line ends in CR CR LF is a finding of its own.
    (found,) = (one for one in everything if one.violation.code != "E106")
    assert found.violation.code == "N201"
    assert found.span is not None
    assert (found.span.line, found.span.column) == (5, 13)


def test_line_ends_may_be_mixed(tmp_path: Path) -> None:
    text = "".join(line + end for line, end in zip(LINES, "\n\r" * 4, strict=False))
    (found,) = check([written(tmp_path, text.replace("\r", "\r\n").encode())]).diagnostics
    assert found.span is not None
    assert found.span.line == 5


def test_a_comment_ends_with_its_line_whatever_ends_the_line(tmp_path: Path) -> None:
    for end in ("\n", "\r\n", "\r\r\n"):
        assert shown(written(tmp_path, end.join(CORRECT).encode())) == ["Größe"]


@pytest.mark.parametrize("rest", [b"\x1a", b"\x00", b"\x00\x00\r\n\x1a", b"\x0c"], ids=repr)
def test_what_old_tools_leave_behind_the_end_is_blank(tmp_path: Path, rest: bytes) -> None:
    assert shown(written(tmp_path, "\n".join(CORRECT).encode() + rest)) == ["Größe"]


def test_the_header_of_the_controller_stands_before_the_module(tmp_path: Path) -> None:
    for header in ("%%%\r\n  VERSION:1\r\n  LANGUAGE:ENGLISH\r\n%%%\r\n\r\n", "%%%VERSION: 1%%%\n"):
        assert shown(written(tmp_path, (header + "\n".join(CORRECT)).encode())) == ["Größe"]


@pytest.mark.parametrize(
    "name", ["A.mod", "A.MOD", "A.modx", "A.sys", "A.sysx", "A.prg", "A", "A.txt"]
)
def test_a_module_is_known_by_its_name_or_by_its_text(tmp_path: Path, name: str) -> None:
    assert shown(written(tmp_path, "\n".join(CORRECT).encode(), name)) == ["Größe"]


def test_other_text_is_no_program(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no MODULE begins in it"):
        simulate([written(tmp_path, b"A letter", "letter.txt")], robot="irb1600")


PROGRAM_FILE = """<?xml version="1.0" encoding="ISO-8859-1" ?>
<Program>
    <Module>Größe.mod</Module>
    <Module>TOOLS.sys</Module>
</Program>
"""


def test_a_program_file_lists_its_modules(tmp_path: Path) -> None:
    main = "MODULE Shop\nPROC main()\nTPWrite greeting;\nENDPROC\nENDMODULE\n"
    tools = 'MODULE Tools\nCONST string greeting:="listed";\nENDMODULE\n'
    written(tmp_path, main.encode(), "Größe.mod")
    written(tmp_path, tools.encode(), "Tools.sys")
    written(tmp_path, b"MODULE Others\nPROC main()\nENDPROC\nENDMODULE\n", "NotListed.mod")
    assert shown(written(tmp_path, PROGRAM_FILE.encode("latin-1"), "cell.pgf")) == ["listed"]


def test_a_program_file_whose_module_is_missing_says_which(tmp_path: Path) -> None:
    pgf = written(tmp_path, PROGRAM_FILE.encode("latin-1"), "cell.pgf")
    with pytest.raises(InputError, match=r"Größe\.mod, which is missing"):
        simulate([pgf], robot="irb1600")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"MODULE x\nENDMODULE\n", "is not a program file"),
        (b"<Program></Program>", "lists no module"),
        (b"<Program><Module>../x.mod</Module></Program>", "is not in the same folder"),
        (b'<!DOCTYPE p [<!ENTITY m "x.mod">]><p><Module>&m;</Module></p>', "document type"),
    ],
    ids=["no XML", "empty", "elsewhere", "entity"],
)
def test_a_wrong_program_file_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        simulate([written(tmp_path, content, "cell.pgf")], robot="irb1600")
