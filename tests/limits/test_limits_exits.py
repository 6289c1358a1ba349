"""Every program of `programs/` ends with a message and a known exit code, whatever is asked of it.

A module, or a folder with a station file, is a case: whoever finds a program that crashes puts it
there.
"""

import shutil
from pathlib import Path

import pytest

import rapidsim
from rapidsim.cli.boundary import run_commands

PROGRAMS = sorted((Path(__file__).parent / "programs").iterdir())
ASKED = (
    ("check",),
    ("run", "--no-record"),
    ("run", "--no-record", "--max-time", "1e-9"),
)
ENDS = range(5)
"""From a clean run to an assertion that does not hold."""


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.stem)
@pytest.mark.parametrize("asked", ASKED, ids=" ".join)
def test_ends_with_a_message(
    program: Path,
    asked: tuple[str, ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # A copy: programs write files, and a run may write beside them.
    own = tmp_path / program.name
    (shutil.copytree if program.is_dir() else shutil.copyfile)(program, own)
    monkeypatch.chdir(tmp_path)
    command, *options = asked
    code = run_commands([command, program.name, *options])
    said = capsys.readouterr()
    told = said.out + said.err
    assert code in ENDS, told
    assert told.strip()
    for word in ("Traceback", "defect", "None"):
        assert word not in told


def test_a_run_may_be_cut_off_where_a_move_begins(capsys: pytest.CaptureFixture[str]) -> None:
    program = Path(__file__).parent / "programs" / "zero_length_first.mod"
    whole = rapidsim.simulate([program], robot="irb1600")
    for edge_s in sorted({time_s for one in whole.moves for time_s in (one.start_s, one.end_s)}):
        for off_s in (-1e-9, 0.0, 1e-9):
            if edge_s + off_s > 0.0:
                limit = f"--max-time={edge_s + off_s!r}"
                code = run_commands(["run", str(program), "--no-record", limit])
                assert code in (0, 3), capsys.readouterr().err
