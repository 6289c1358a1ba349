"""`--max-wall` holds, whatever the program is busy with: within 2 s of processor time."""

import json
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import call

from rapidsim.analysis.program import Program
from rapidsim.cli.boundary import run_commands
from rapidsim.controller.motion import TaskMotion
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.reach import trial_run
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.simulate import simulate, simulate_tasks
from rapidsim.simulation.task_run import TaskSetup

WALL_S = 0.1
BEYOND_S = 2.0

DATA = """
  CONST robtarget p1:=[[800,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget far:=[[9000,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;
  VAR jointtarget joints;
  VAR iodev file;
  VAR num n;
  VAR num many{1000000};
  VAR num others{1000000};
"""
CHAIN = "\n".join(f"  PROC q{i}()\n    q{i + 1};\n    q{i + 1};\n  ENDPROC" for i in range(60))


def forever(body: str, *, first: str = "", more: str = "") -> str:
    """A program that does something again and again without letting time pass."""
    return (
        f"MODULE job\n{DATA}\n  PROC main()\n{first}\n    WHILE TRUE DO\n      n:=n+1;\n{body}\n"
        f"    ENDWHILE\n  ENDPROC\n{more}\nENDMODULE\n"
    )


def once(body: str, more: str) -> str:
    return f"MODULE job\n{DATA}\n  PROC main()\n{body}\n  ENDPROC\n{more}\nENDMODULE\n"


FIB = once(
    "    n:=fib(60);",
    "  FUNC num fib(num n)\n    IF n<2 RETURN n;\n    RETURN fib(n-1)+fib(n-2);\n  ENDFUNC",
)
UNREACHED = forever(
    "      attempt;",
    more="  PROC attempt()\n    joints:=CalcJointT(far,tool0);\n  ERROR\n    TRYNEXT;\n  ENDPROC\n"
    "  PROC spare()\n    MoveL far,v100,fine,tool0;\n  ENDPROC",
)
TO_P1 = "    MoveJ p1,v1000,fine,tool0;\n"
SLOW_FLY_BY = (
    TO_P1
    + "    ConfL \\Off;\n    MoveL Offs(p1,0,300,0),v5,z50,tool0;\n"
    + "    MoveL Offs(p1,0,-300,0),v5,z50,tool0;"
)
FILE = '    Open "m.mod",file\\Write;\n    Write file,"MODULE m";\n    Write file,"ENDMODULE";\n'
FILE += "    Close file;"
MODULES = '      Load "m.mod";\n      UnLoad "m.mod";'
WAYS = {
    "recursion": FIB,
    "retries that are counted anew": once(
        "    n:=1/(n-n);\n  ERROR\n    ResetRetryCount;\n    RETRY;", ""
    ),
    "UNDO clauses that begin anew": once(
        "    deep;",
        "  PROC deep()\n    WHILE TRUE DO\n      n:=n+1;\n    ENDWHILE\n"
        "  UNDO\n    deep;\n  ENDPROC",
    ),
    "calls of calls": once("    q0;", CHAIN + "\n  PROC q60()\n    n:=n+1;\n  ENDPROC"),
    "targets out of reach": UNREACHED,
    "moves of a thousandth of a millimetre": forever(
        "      MoveL Offs(p1,0.001*n,0,0),v100,z0,tool0;", first=TO_P1
    ),
    "the same with stops": forever(
        "      MoveL Offs(p1,0.001*n,0,0),v100,fine,tool0;", first=TO_P1
    ),
    "copies": forever('      CopyFile "m.mod","b"+NumToStr(n,0);', first=FILE),
    "folders": forever('      MakeDir "b"+NumToStr(n,0);'),
    "files": forever('      Open "a.txt",file\\Append;\n      Write file,"x";\n      Close file;'),
    "modules": forever(MODULES, first=FILE),
    "a position in a fly-by": forever("      here:=CRobT();", first=SLOW_FLY_BY),
    "a stop and a start": forever("      StopMove;\n      StartMove;", first=SLOW_FLY_BY),
    "inverse kinematics": forever("      joints:=CalcJointT(p1,tool0);"),
    "texts": forever('      TPWrite "again";'),
    "large arrays": forever("      many:=others;"),
}
BY_SEARCH = {
    "moves": forever(
        "      MoveL Offs(p1,-300-100*Sin(n*7),100*Sin(n),-400),v100,z10,tool0;",
        first="    MoveJ Offs(p1,-300,0,-400),v1000,fine,tool0;",
    ),
    "a position after each move": forever(
        "      MoveL Offs(p1,-300-100*Sin(n*7),100*Sin(n),-400),v100,z10,tool0;\n"
        "      here:=CRobT();",
        first="    MoveJ Offs(p1,-300,0,-400),v1000,fine,tool0;",
    ),
}


def options(home: Path, wall_s: float = WALL_S) -> RunOptions:
    return RunOptions(home=home, max_time_s=1e7, max_wall_s=wall_s)


def _timed(program: Program, arm: Robot, asked: RunOptions) -> tuple[Simulation, float]:
    began_s = time.process_time()
    return simulate(program, arm, options=asked), time.process_time() - began_s


def cut_off(text: str, home: Path, robot: str = "irb1600", *, wall_s: float = WALL_S) -> Simulation:
    """Run until the computer's clock ends it; the processor time is that of this process alone.

    What takes too long is tried again: the first run that needs a loop may compile it.
    """
    loaded = load([SourceFile("job.mod", text, "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    arm = load_robot(robot)
    it, took_s = _timed(loaded.program, arm, options(home, wall_s))
    if took_s >= wall_s + BEYOND_S:
        it, took_s = _timed(loaded.program, arm, options(home, wall_s))
    assert took_s < wall_s + BEYOND_S
    assert it.end is End.TIME_LIMIT
    assert it.diagnostics[-1].violation.message.endswith(
        f"after {wall_s:g} s on the computer's clock"
    )
    return it


@pytest.mark.parametrize("way", WAYS)
def test_a_program_that_is_busy(way: str, tmp_path: Path) -> None:
    cut_off(WAYS[way], tmp_path)


@pytest.mark.parametrize("way", BY_SEARCH)
def test_an_arm_whose_joints_are_searched_for(way: str, tmp_path: Path) -> None:
    cut_off(BY_SEARCH[way], tmp_path, "crb15000")


def test_one_large_module(tmp_path: Path) -> None:
    """It is interrupted where it stands, in the parser or behind it."""
    lines = "".join(f"    n{i % 50}:=n{(i + 1) % 50}+{i};\n" for i in range(60_000))
    data = "".join(f"  VAR num n{i};\n" for i in range(50))
    (tmp_path / "big.mod").write_text(
        f"MODULE big\n{data}  PROC all()\n{lines}  ENDPROC\nENDMODULE\n"
    )
    it = cut_off(once('    Load "big.mod";', ""), tmp_path)
    assert it.time_s == 0.0


def test_several_tasks(tmp_path: Path) -> None:
    texts = (UNREACHED, forever("      here:=CRobT();", first=SLOW_FLY_BY))
    programs = [load([SourceFile("job.mod", text, "utf-8")]).program for text in texts]
    setups = [
        TaskSetup(f"T_ROB{number}", program, load_robot("irb1600"))
        for number, program in enumerate(programs, 1)
        if program is not None
    ]
    began_s = time.process_time()
    it = simulate_tasks(setups, options(tmp_path))
    assert time.process_time() - began_s < WALL_S + BEYOND_S
    assert it.end is End.TIME_LIMIT


def test_what_was_done_before_is_told(tmp_path: Path) -> None:
    it = cut_off(forever("      here:=CRobT();", first=SLOW_FLY_BY), tmp_path, wall_s=0.25)
    assert it.moves
    assert it.time_s > it.moves[0].end_s
    assert it.only.trajectory.duration > 0.0


def test_what_was_noted_is_written_in_time_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The more events there are, the earlier the run is over."""
    file = tmp_path / "job.mod"
    file.write_text(forever('      TPWrite "again";\n      Set doLamp;\n      Reset doLamp;'))
    given = ("--max-wall", 0.2, "--no-record", "--events", tmp_path / "e.jsonl", "--format", "json")
    began_s = time.process_time()
    assert run_commands(["run", str(file), *map(str, given)]) == 3
    assert time.process_time() - began_s < 0.2 + BEYOND_S
    assert len(json.loads(capsys.readouterr().out)["events"]) > 1000


def test_a_run_that_ends_in_time_is_the_same(tmp_path: Path) -> None:
    text = once("    MoveJ p1,v1000,fine,tool0;\n    n:=sum(20);", SUM)
    loaded = load([SourceFile("job.mod", text, "utf-8")])
    assert loaded.program is not None
    arm = load_robot("irb1600")
    free = simulate(loaded.program, arm, options=RunOptions(home=tmp_path))
    watched = simulate(loaded.program, arm, options=RunOptions(home=tmp_path, max_wall_s=1e6))
    assert (watched.time_s, watched.end) == (free.time_s, free.end)


SUM = "  FUNC num sum(num n)\n    IF n<1 RETURN 0;\n    RETURN n+sum(n-1);\n  ENDFUNC"


def test_a_call_of_oneself_takes_a_tick_as_a_turn_of_a_loop_does(tmp_path: Path) -> None:
    loaded = load([SourceFile("job.mod", once("    n:=sum(20);", SUM), "utf-8")])
    assert loaded.program is not None
    it = simulate(loaded.program, load_robot("irb1600"), options=RunOptions(home=tmp_path))
    assert it.time_s == pytest.approx(21 * 1e-5)


def test_recursion_meets_the_limit_of_virtual_time(tmp_path: Path) -> None:
    loaded = load([SourceFile("job.mod", FIB, "utf-8")])
    assert loaded.program is not None
    it = simulate(
        loaded.program, load_robot("irb1600"), options=RunOptions(home=tmp_path, max_time_s=1.0)
    )
    assert it.end is End.TIME_LIMIT
    assert it.time_s == pytest.approx(1.0)


def test_the_run_of_a_check_is_cut_off_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(trial_run, "LONGEST_WORK_FOR_ERRORS_S", WALL_S)
    file = tmp_path / "job.mod"
    file.write_text(UNREACHED, "utf-8")
    began_s = time.process_time()
    assert run_commands(["check", str(file)]) == 1
    assert time.process_time() - began_s < WALL_S + BEYOND_S
    assert "unreachable" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("last", "end"),
    [
        ("WHILE TRUE DO\n      n:=n+1;\n    ENDWHILE", End.TIME_LIMIT),
        ("EXIT;", End.STOPPED),
        ("n:=1/(n-n);", End.ERROR),
    ],
)
def test_a_clock_that_runs_out_while_a_stopped_run_comes_to_rest(
    last: str, end: End, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What ended the run is told, and the robot is left on its way."""
    moves = "".join(f"    MoveL Offs(p1,-300,{y},-400),v20,z10,tool0;\n" for y in (0, 90))
    loaded = load([SourceFile("job.mod", once(f"{TO_P1}{moves}    {last}", ""), "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    ends: list[str] = []
    for service, name in ((TaskCoordination, "stop_robot"), (TaskMotion, "abandon")):
        monkeypatch.setattr(service, name, _out_of_time(getattr(service, name), ends))
    options = RunOptions(home=tmp_path, max_time_s=2.0)
    run = simulate(loaded.program, load_robot("irb1600"), options=options)
    assert ends
    assert run.end is end


def _out_of_time(original: Callable[..., None], ends: list[str]) -> Callable[..., None]:
    """Something done at the end of a run, when the computer's clock has just run out."""

    def done(service: TaskMotion | TaskCoordination, *rest: float) -> None:
        ends.append(original.__name__)
        service.cell.watchdog._is_over = True
        original(service, *rest)

    return done


def test_a_call_that_never_looks_at_the_clock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The run is interrupted wherever it is, and says so."""

    def busy(_service: TaskCoordination) -> None:
        while True:
            pass

    monkeypatch.setattr(TaskCoordination, "task_number", property(busy))
    text = once("    name:=GetTaskName(\\TaskNo:=n);", "  VAR string name;")
    loaded = load([SourceFile("job.mod", text, "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    run = simulate(loaded.program, load_robot("irb1600"), options=options(tmp_path))
    assert run.end is End.TIME_LIMIT
    assert run.diagnostics[-1].code == "R109"


@pytest.mark.parametrize("given", [(), ("-j", "2", "--each")], ids=" ".join)
def test_a_check_may_be_limited(given: tuple[str, ...], tmp_path: Path) -> None:
    lines = "".join(f"    IF n>{i} n:=n*{i}+Sin(n);\n" for i in range(100_000))
    for name in ("one.mod", "two.mod"):
        module = Path(name).stem
        text = f"MODULE {module}\n  VAR num n;\n  PROC p_{module}()\n{lines}  ENDPROC\nENDMODULE\n"
        (tmp_path / name).write_text(text)
    limit = ("--max-wall", "0.3", "--no-cache")
    ended = call("check", "one.mod", "two.mod", *given, *limit, cwd=tmp_path)
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.startswith("error: --max-wall ended the command")


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="shells of Windows have no such jobs")
def test_the_check_of_a_background_job_is_limited_too(tmp_path: Path) -> None:
    """A shell starts such jobs deaf to SIGINT."""
    lines = "".join(f"    IF n>{i} n:=n*{i}+Sin(n);\n" for i in range(100_000))
    text = f"MODULE one\n  VAR num n;\n  PROC p()\n{lines}  ENDPROC\nENDMODULE\n"
    (tmp_path / "one.mod").write_text(text)
    ignoring = "import signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); "
    command = "from rapidsim.cli import main; sys.argv = ['rapidsim', *sys.argv[1:]]; main()"
    done = subprocess.run(
        [sys.executable, "-c", ignoring + command, "check", "one.mod", "--max-wall", "0.3"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert (done.returncode, done.stdout) == (3, "")
    assert "--max-wall ended the command" in done.stderr


def test_a_zone_is_watched_no_longer_than_the_run(tmp_path: Path) -> None:
    program = Path(__file__).with_name("zone_and_a_move_of_days.mod")
    ended = call("run", program, "--no-record", "--max-time", "20", cwd=tmp_path)
    assert ended.code == 3
    # A thousandth of a millimetre a second is meant.
    assert call("check", program, "--ignore", "M516", cwd=tmp_path).code == 0
