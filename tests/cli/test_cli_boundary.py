"""What happens at the edge of the process: defects, interruption, closed pipes, colours."""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from cli_helper import HEARS, rapidsim

BROKEN = """
from greenlet import GreenletExit
from rapidsim.language.errors import Stopped
import rapidsim.diagnostics as diagnostics
def fail():
    raise {what}
diagnostics.all_rules = fail
from rapidsim.cli import main
main()
"""


def broken(what: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `explain` of an installation in which it fails."""
    return subprocess.run(
        [sys.executable, "-c", BROKEN.format(what=what), "explain", "N201", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.process
def test_a_defect_is_one_line_that_says_how_to_report_it() -> None:
    done = broken("KeyError('lost')")
    assert (done.returncode, done.stdout) == (70, "")
    assert len(done.stderr.splitlines()) == 1
    for part in ("has a defect", "KeyError: 'lost'", "please report"):
        assert part in done.stderr


@pytest.mark.process
def test_a_defect_shows_its_traceback_when_asked() -> None:
    done = broken("KeyError('lost')", "-v")
    assert done.returncode == 70
    assert "Traceback (most recent call last)" in done.stderr
    assert "please report" in done.stderr.splitlines()[-1]


@pytest.mark.process
def test_an_interruption_is_one_line() -> None:
    done = broken("KeyboardInterrupt")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


@pytest.mark.process
def test_a_closed_pipe_is_quiet() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "rapidsim", "explain", "--all"],
        stdout=writing,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(writing)
    assert (done.returncode, done.stderr) == (2, b"")


@pytest.mark.parametrize("arguments", [("explain", "nothing"), ("explain", "K603")])
def test_closed_pipes_are_quiet_for_messages_too(arguments: tuple[str, ...]) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "rapidsim", *arguments], stdout=writing, stderr=writing, check=False
    )
    os.close(writing)
    assert done.returncode == 2


@pytest.mark.parametrize(
    "what", ["Stopped('by itself')", "GreenletExit()", "GeneratorExit()", "RecursionError()"]
)
def test_whatever_is_no_exit_is_a_defect(what: str) -> None:
    done = broken(what)
    assert (done.returncode, done.stdout) == (70, "")
    assert "has a defect" in done.stderr
    assert len(done.stderr.splitlines()) == 1


ENDED_WHILE_WRITING = """
import os
from pathlib import Path
Path.replace = lambda written, final: os.kill(os.getpid(), signal.{name})
from rapidsim.cli import main
main()
"""


@pytest.mark.skipif(os.name != "posix", reason="only there a process is asked to end")
@pytest.mark.parametrize(
    ("name", "code", "word"), [("SIGTERM", 143, "terminated"), ("SIGINT", 130, "interrupted")]
)
def test_an_end_from_outside_leaves_no_half_file(
    name: str, code: int, word: str, tmp_path: Path
) -> None:
    (tmp_path / "a.mod").write_text("MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    (tmp_path / "a.csv").write_text("older")
    command = ["run", "a.mod", "--no-record", "--trace", "a.csv"]
    done = subprocess.run(
        [sys.executable, "-c", HEARS + ENDED_WHILE_WRITING.format(name=name), *command],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (
        code,
        f"{word} after the run (0.000 s, 0 moves): not all outputs were written\n",
    )
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "a.mod"]
    assert (tmp_path / "a.csv").read_text() == "older"


@pytest.mark.process
def test_colours_are_for_terminals() -> None:
    pty = pytest.importorskip("pty", reason="this system has no pseudo terminals")
    reading, writing = pty.openpty()
    subprocess.run(
        [sys.executable, "-m", "rapidsim", "explain", "N201"],
        stdout=writing,
        stdin=subprocess.DEVNULL,
        env={"PATH": os.environ["PATH"], "TERM": "xterm", "COLUMNS": "80"},
        check=False,
    )
    os.close(writing)
    output = b""
    with contextlib.suppress(OSError):  # Linux says so at the end; macOS reads nothing.
        while some := os.read(reading, 65536):
            output += some
    os.close(reading)
    assert b"\x1b[" in output


@pytest.mark.parametrize("arguments", [("explain", "N201"), ("robots",), ("check", "wrong.mod")])
def test_colours_are_for_terminals_that_want_them(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "wrong.mod").write_text("MODULE a\n  PROC main()\n    x:=;\n  ENDPROC\nENDMODULE\n")

    def shown(*options: str, terminal: bool = True, **environment: str) -> str:
        variables = {"TERM": "xterm", **environment}
        call = rapidsim(
            *arguments, *options, cwd=tmp_path, environment=variables, terminal=terminal
        )
        return call.out

    assert "\x1b[" in shown()
    assert "\x1b" not in shown(NO_COLOR="1")
    assert "\x1b" not in shown(TERM="dumb")
    assert "\x1b" not in shown("--no-color")
    assert "\x1b" not in shown(terminal=False)


def printed_to(shell_redirection: str, *arguments: str) -> subprocess.CompletedProcess[bytes]:
    """A command as a shell starts it with its output led somewhere."""
    command = f'exec "$0" -m rapidsim {" ".join(arguments)} {shell_redirection}'
    return subprocess.run(
        ["sh", "-c", command, sys.executable], stderr=subprocess.PIPE, check=False
    )


@pytest.mark.process
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full disk to try")
def test_output_to_a_full_disk_is_no_defect() -> None:
    for arguments in (("explain", "K603"), ("robots", "irb120")):
        done = printed_to("> /dev/full", *arguments)
        said = b"error: the output cannot be written: No space left on device\n"
        assert (done.returncode, done.stderr) == (2, said)


@pytest.mark.process
@pytest.mark.skipif(os.name != "posix", reason="a shell is needed to close the stream")
def test_a_closed_stream_takes_nothing_and_breaks_nothing() -> None:
    assert (printed_to(">&-", "explain", "K603").returncode) == 0
    assert (printed_to("2>&-", "explain", "nothing").returncode) == 2


@pytest.mark.process
@pytest.mark.parametrize(
    ("encoding", "degrees", "rule"), [("ascii", " deg", "-"), ("latin-1", "°", "-")]
)
def test_signs_a_code_page_lacks_are_replaced_by_like_ones(
    encoding: str, degrees: str, rule: str, tmp_path: Path
) -> None:
    (tmp_path / "a.mod").write_text(
        "MODULE a\nPROC main()\nMoveAbsJ [[9,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;"
        "\nENDPROC\nENDMODULE\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "rapidsim", "run", "a.mod", "--no-record"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONIOENCODING": encoding, "COLUMNS": "80"},
        capture_output=True,
        check=False,
    )
    shown = done.stdout.decode(encoding)
    assert f"{degrees} of its limit" in shown
    assert rule * 80 in shown
    assert "\\u" not in shown


def test_a_narrow_terminal_costs_no_digit() -> None:
    pose = ("--position", "800,0,800", "--quaternion", "0,0,1,0")
    wide = rapidsim("kin", "ik", *pose, columns=120).out
    narrow = rapidsim("kin", "ik", *pose, columns=40).out
    rows = [line for line in wide.splitlines() if line.startswith("[")]
    assert len(rows) == 4
    assert all(row in narrow for row in rows)


def test_lines_end_without_spaces() -> None:
    for arguments in (("robots",), ("robots", "irb6640"), ("kin", "fk", "--joints", "0,0,0,0,0,0")):
        assert all(line == line.rstrip() for line in rapidsim(*arguments).out.splitlines())


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "many"])
def test_what_is_no_finite_number_is_refused(value: str) -> None:
    for arguments in (("run", "--max-time"), ("run", "--dt"), ("follow", "--acceleration")):
        ended = rapidsim(arguments[0], "nothing", f"{arguments[1]}={value}")
        assert (ended.code, "number" in ended.err) == (2, True)


def test_help_tells_no_range_that_is_none() -> None:
    assert "None" not in rapidsim("kin", "ik", "--help").out


def test_no_line_of_help_is_cut() -> None:
    for command in ((), ("kin",)):
        listed = rapidsim(*command, "--help").out.partition("Commands:")[2]
        assert listed
        assert not [line for line in listed.splitlines() if line.endswith("...")]


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("rapidsim ki", "plain,kin"),
        ("rapidsim kin ", "plain,fk"),
        ("rapidsim run --rec", "--record"),
        ("rapidsim check pro", "file,pro"),
        ("rapidsim run job.mod --station ", "file,"),
        ("rapidsim run job.mod --plots ", "dir,"),
        ("rapidsim run job.mod --robot irb1600-6", "plain,irb1600-6-1.2"),
        ("rapidsim kin fk --robot rv", "plain,rv-m1"),
        ("rapidsim diff old/ ne", "file,ne"),
        ("rapidsim robots irb120", "plain,irb120-3-0.58"),
        ("rapidsim explain K603", "plain,K603"),
        ("rapidsim check job.mod --ignore S901,S9", "plain,S901,S902"),
        ("rapidsim check job.mod --output-format s", "plain,sarif"),
    ],
)
def test_a_shell_is_told_which_words_may_follow(words: str, wanted: str) -> None:
    environment = {
        "_RAPIDSIM_COMPLETE": "bash_complete",
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split(" ")) - 1),
    }
    ended = rapidsim(environment=environment)
    assert ended.code == 0, ended.err
    assert wanted in ended.out


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_is_given_what_it_evaluates(shell: str, tmp_path: Path) -> None:
    script = rapidsim(environment={"_RAPIDSIM_COMPLETE": f"{shell}_source"}).out
    assert f"{shell}_complete" in script
    if shutil.which(shell):
        (tmp_path / "script").write_text(script)
        assert subprocess.run([shell, "-n", tmp_path / "script"], check=False).returncode == 0
