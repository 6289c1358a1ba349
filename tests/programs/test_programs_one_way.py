"""The Python API goes the way of the commands: it gives what they print, program by program."""

import io
import json
import pickle
import shutil
from pathlib import Path
from unittest.mock import patch

import pytest
from command_line import call

import rapidsim
from rapidsim.cli.terminal import Terminal
from rapidsim.cli.tools.check_output import checked_text
from rapidsim.files import InputError
from rapidsim.frames.transform import Transform
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError
from rapidsim.json_records.encoding import json_of
from rapidsim.report.findings.diagnostic_records import diagnostic_record
from rapidsim.report.findings.merging import merged
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, run_json
from rapidsim.simulation.options import RunOptions

ROOT = Path(__file__).parents[2]
LONGEST_S = 3.0
PROGRAMS = (
    "programs/algorithms.mod",
    "programs/circle.mod",
    "programs/out_of_reach.mod",
    "programs/pentagon.mod",
    "programs/cell",
    "programs/two_robots",
    "programs/multimove/Left.mod",
    "tests/check/corpus/backup",
    "tests/check/corpus/handling",
    "tests/analysis/programs/two_modules",
    "tests/rapid/modules/same_names",
    "tests/cli/programs/wrong.mod",
    "rapidsim/rules/N215-component-of-unknown-type/bad.mod",
)
MODULE = """MODULE tiny
  VAR num unused;
  PROC main()
    VAR iodev file;
    WaitDI diStart, 1;
    Open "HOME:" \\File:="said.txt", file \\Write;
    Write file, CDate();
    Close file;
    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
  ENDPROC
ENDMODULE
"""
STATION = """[clock]
start = 2024-05-06T00:00:00
[robot]
model = "irb120"
start = [5, 0, 0, 0, 30, 0]
[signals]
diStart = { type = "di", value = 0 }
[[stimulus]]
at = 0.5
set = { diStart = 1 }
[check]
ignore = ["unused-data"]
extend-select = ["S9"]
"""


def command(*arguments: object, cwd: Path, stdin: bytes = b"") -> dict[str, object]:
    """What a command prints as JSON."""
    ended = call(*arguments, cwd=cwd, stdin=stdin)
    assert ended.code in (0, 1, 3), ended.err
    printed: dict[str, object] = json.loads(ended.out)
    return printed


def checked(path: str) -> object:
    result = rapidsim.check([path])
    text = checked_text("json", merged(result.diagnostics), result, Terminal(), is_ok=result.ok)
    return json.loads(text)


def assert_run_as_printed(path: str, printed: dict[str, object]) -> None:
    try:
        run = rapidsim.simulate([path], max_time=LONGEST_S)
    except ProgramRejectedError as rejected:
        assert printed["models"] == {}, "the command ran it"
        found = [json_of(diagnostic_record(one)) for one in merged(rejected.diagnostics)]
        assert json.loads(json.dumps(found)) == printed["diagnostics"]
    else:
        report = run_json(run, figures(run), run.diagnostics, RunFiles())
        assert json.loads(json.dumps(report)) == printed


def assert_one_way(path: str, one: Path, other: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two folders with the same files one is for the commands, one for Python."""
    said = command("check", path, "--output-format", "json", cwd=one)
    limit = ("--max-time", LONGEST_S)
    ran = command("run", path, "--no-record", "--format", "json", *limit, cwd=one)
    monkeypatch.chdir(other)
    assert checked(path) == said
    assert_run_as_printed(path, ran)


@pytest.mark.parametrize("program", PROGRAMS)
def test_python_gives_what_the_commands_print(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = ROOT / program
    folder = source if source.is_dir() else source.parent
    for copy in ("one", "other"):
        if source.is_dir() or (folder / "rapidsim.toml").exists():
            shutil.copytree(folder, tmp_path / copy / folder.name)
        else:
            (tmp_path / copy / folder.name).mkdir(parents=True)
            shutil.copy(source, tmp_path / copy / folder.name)
    path = folder.name if source.is_dir() else f"{folder.name}/{source.name}"
    assert_one_way(path, tmp_path / "one", tmp_path / "other", monkeypatch)


def test_a_station_above_the_program_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for copy in ("one", "other"):
        place = tmp_path / copy / "below"
        place.mkdir(parents=True)
        (place.parent / "rapidsim.toml").write_text(STATION)
        (place / "tiny.mod").write_text(MODULE)
    assert_one_way("below/tiny.mod", tmp_path / "one", tmp_path / "other", monkeypatch)
    assert (tmp_path / "other" / "tiny.home" / "said.txt").read_text() == "2024-05-06\n"


def test_a_baseline_of_the_station_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for copy in ("one", "other"):
        (tmp_path / copy).mkdir()
        (tmp_path / copy / "rapidsim.toml").write_text('[check]\nbaseline = "known.json"\n')
        (tmp_path / copy / "tiny.mod").write_text(MODULE)
        call("check", "tiny.mod", "--baseline", "known.json", cwd=tmp_path / copy)
        text = MODULE.replace("VAR num unused;", "VAR num unused; VAR num late;")
        (tmp_path / copy / "tiny.mod").write_text(text)
    assert_one_way("tiny.mod", tmp_path / "one", tmp_path / "other", monkeypatch)
    result = rapidsim.check(["tiny.mod"])
    assert result.known
    assert all(one not in result.diagnostics for one in result.known)


def test_a_job_can_be_sent_to_another_process(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text('[check.per-file-ignores]\n"*.sys" = ["N2"]\n')
    (tmp_path / "tiny.mod").write_text(MODULE)
    asked = job(RunRequest(paths=(str(tmp_path),)))
    sent = pickle.loads(pickle.dumps(asked))
    assert (sent.station, sent.robot) == (asked.station, asked.robot)
    assert check_job(sent).diagnostics


def test_standard_input_is_a_program_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = MODULE.encode()
    said = command("check", "-", "--output-format", "json", cwd=tmp_path, stdin=text)
    limit = ("--max-time", LONGEST_S)
    arguments = ("run", "-", "--no-record", "--format", "json", *limit)
    ran = command(*arguments, cwd=tmp_path, stdin=text)
    monkeypatch.chdir(tmp_path)
    with patch("sys.stdin", io.TextIOWrapper(io.BytesIO(text))):
        assert checked("-") == said
    with patch("sys.stdin", io.TextIOWrapper(io.BytesIO(text))):
        assert_run_as_printed("-", ran)


def test_options_count_more_than_the_station_where_they_say_something(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("rapidsim.toml").write_text(STATION)
    Path("tiny.mod").write_text(MODULE)
    place = Transform.from_quaternion((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    options = RunOptions(world_from_base=place, task="T_OTHER", max_time_s=9.0)
    run = rapidsim.simulate(["tiny.mod"], robot="irb1600", options=options)
    assert (run.robot.name, run.task) == ("irb1600-6-1.2", "T_OTHER")
    assert run.world_from_base.translation.tolist() == [0.0, 0.0, 1.0]
    assert run.trajectory.joints[0][0] == pytest.approx(0.0872664626)
    other = RunOptions(start_joints_deg=(7.0, 0.0, 0.0, 0.0, 30.0, 0.0), home=tmp_path)
    run = rapidsim.simulate(["tiny.mod"], options=other)
    assert run.robot.name == "irb120-3-0.58"
    assert run.trajectory.joints[0][0] == pytest.approx(0.1221730476)
    assert (tmp_path / "said.txt").exists()
    with pytest.raises(InputError, match="no procedure `nowhere`"):
        rapidsim.simulate(["tiny.mod"], options=RunOptions(entry="nowhere"))
