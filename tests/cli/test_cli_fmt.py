"""`rapidsim fmt`: files written, shown as a difference, or only judged."""

from pathlib import Path

import pytest
from command_line import call

UGLY = b"\xef\xbb\xbfmodule m\r\n! one\r\nproc main()\r\nStop;  \r\nendproc\r\nendmodule\r\n"
TIDY = (
    b"\xef\xbb\xbfMODULE m\r\n    ! one\r\n    PROC main()\r\n        Stop;\r\n    ENDPROC\r\n"
    b"ENDMODULE\r\n"
)
BROKEN = b"MODULE b\nPROC main(\nENDPROC\nENDMODULE\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, data in (("m.mod", UGLY), ("t.mod", TIDY.replace(b"e m", b"e t")), ("b.mod", BROKEN)):
        (tmp_path / name).write_bytes(data)
    return tmp_path


def test_files_are_written_with_their_bytes_and_a_broken_one_is_left(folder: Path) -> None:
    it = call("fmt", ".", cwd=folder)
    assert (it.code, it.out) == (1, "")
    assert it.err == (
        "b.mod:2:11: error[E113] `)` is missing in the head of PROC `main`\n"
        "1 file changed, 1 left as it is (syntax errors), 1 unchanged\n"
    )
    assert (folder / "m.mod").read_bytes() == TIDY
    assert (folder / "b.mod").read_bytes() == BROKEN
    again = call("fmt", "m.mod", "t.mod", cwd=folder)
    assert (again.code, again.err) == (0, "2 files unchanged\n")


def test_check_and_diff_change_nothing(folder: Path) -> None:
    it = call("fmt", "--check", "m.mod", "t.mod", cwd=folder)
    assert (it.code, it.out) == (1, "m.mod is not laid out\n")
    assert it.err == "1 file would be changed, 1 unchanged\n"
    shown = call("fmt", "--diff", "-q", "m.mod", "t.mod", cwd=folder)
    assert (shown.code, shown.err) == (1, "")
    assert shown.out.startswith("--- m.mod\n+++ m.mod\n@@ -1,6 +1,6 @@\n-module m\n")
    assert (folder / "m.mod").read_bytes() == UGLY
    assert call("fmt", "--check", "t.mod", cwd=folder).code == 0


def test_standard_input_is_printed(folder: Path) -> None:
    it = call(
        "fmt",
        "-",
        "--indent",
        "2",
        "--words",
        "keep",
        cwd=folder,
        stdin=b"module m\n! a\nendmodule\n",
    )
    assert (it.code, it.out, it.err) == (0, "module m\n  ! a\nendmodule\n", "")
