"""What happens to answers that are none: at a terminal the question comes again."""

import os
import sys
from pathlib import Path

import pytest
from cli_helper import rapidsim

if sys.platform == "win32":
    pytest.skip("a pseudo-terminal is needed, which Windows has not", allow_module_level=True)

import pty

PROGRAM = """MODULE asks
  PROC main()
    VAR num n;
    TPReadNum n, "How many?";
    TPReadFK n, "Go on? " + NumToStr(n, 1), "Yes", "No", stEmpty, stEmpty, stEmpty;
    TPWrite "key " \\Num:=n;
  ENDPROC
ENDMODULE
"""
RUN = ("run", "asks.mod", "--no-record")


@pytest.mark.process
def test_somebody_at_a_terminal_is_asked_again(tmp_path: Path) -> None:
    (tmp_path / "asks.mod").write_text(PROGRAM)
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(tmp_path)
        os.environ.update(TERM="dumb", COLUMNS="200", PYTHONIOENCODING="utf-8")
        os.execv(sys.executable, [sys.executable, "-m", "rapidsim", *RUN])
    typed = ["seven", "1e999", "7.5", "perhaps", "2"]
    shown, answered = b"", 0
    while True:
        try:
            some = os.read(terminal, 65536)
        except OSError:  # Linux says so when the program has ended; macOS reads nothing.
            break
        if not some:
            break
        shown += some
        while shown.count(b": ") > answered and typed:
            answered += 1
            os.write(terminal, typed.pop(0).encode() + b"\n")
    os.close(terminal)
    _, status = os.waitpid(process, 0)
    text = shown.decode()
    assert os.waitstatus_to_exitcode(status) == 0
    assert typed == []
    assert "`seven` is not a number, such as 12 or -0.5. How many?: " in text
    assert "`1e999` is not a number, such as 12 or -0.5. How many?: " in text
    assert "`perhaps` is not one of the keys. Go on? 7.5 Yes / No: " in text
    assert "key 2" in text
    assert "R103" not in text
    assert "R105" not in text


def test_a_file_is_read_once_and_the_default_is_told(tmp_path: Path) -> None:
    (tmp_path / "asks.mod").write_text(PROGRAM)
    (tmp_path / "answers.txt").write_text("seven\nNo\n")
    ended = rapidsim(*RUN, "--answers", "answers.txt", cwd=tmp_path)
    assert ended.code == 0
    assert "the answer `seven` to `How many?` is not a number; 0 was taken" in ended.out
    assert "key 2" in ended.out
