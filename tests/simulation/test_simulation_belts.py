"""Moves that follow belts: exactly on the belt, without jumps, within the limits of the arm."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from laws import some

import rapidsim
from rapidsim.api.run import Run
from rapidsim.motion.path.belt_offsets import belt_offsets
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.trajectory.limit_shares import limit_shares
from rapidsim.motion.trajectory.trajectory import Trajectory

_DATA = r"""MODULE belts
  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[10,20,0],[1,0,0,0]]];
  CONST robtarget pPart:=[[0,0,80],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWait:=[[50,600,650],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBox:=[[600,-120,481],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;
  PROC main()
    ConfJ\Off;
    ConfL\Off;
"""
_STEP_S = 0.001


def station(speed: float, angle: float = 0.0, smoothing: str = "axes", more: str = "") -> str:
    """A belt that passes in front of the arm."""
    x, y = -300.0 * np.cos(angle), 600.0 - 300.0 * np.sin(angle)
    return f"""[robot]
model = "irb1600-6-1.2"
start = [60, 0, 0, 0, 30, 0]

[motion]
smoothing = "{smoothing}"

[signals]
doRun = {{ type = "do", value = 1 }}

[[conveyor]]
unit = "CNV1"
speed = {speed}
at = 0.2
every = 1.0
length = 420
runs = "doRun = 1"
position = [{x}, {y}, 400]
quaternion = [{np.cos(angle / 2)}, 0, 0, {np.sin(angle / 2)}]
{more}
"""


def run_of(folder: Path, body: str, toml: str) -> Run:
    (folder / "rapidsim.toml").write_text(toml)
    (folder / "belts.mod").write_text(f"{_DATA}{body}\n  ENDPROC\nENDMODULE\n")
    return rapidsim.load(folder).run()


def random_body(say: random.Random) -> str:
    """Two visits to the belt, each with a few moves on it."""
    lines = []

    def near() -> str:
        x, y, z = say.uniform(-40, 40), say.uniform(-40, 40), say.uniform(0, 120)
        return f"Offs(pPart,{x:.1f},{y:.1f},{z:.1f})"

    def how() -> str:
        speed = say.choice(("v200", "v400", "v800", "v2000", "vmax"))
        return f"{speed},{say.choice(('fine', 'z1', 'z10', 'z20', 'z50'))},tGrip"

    for _ in range(2):
        lines.append(f"MoveJ pWait,{how()};")
        lines.append(rf"WaitWObj wBelt\RelDist:={say.uniform(100, 250):.0f};")
        for _ in range(say.randint(1, 3)):
            kind = say.random()
            if kind < 0.8:
                instruction = "MoveL" if kind < 0.6 else "MoveJ"
                lines.append(rf"{instruction} {near()},{how()}\WObj:=wBelt;")
            else:
                r = say.uniform(20, 40)
                lines.append(rf"MoveL Offs(pPart,{-r:.1f},0,60),{how()}\WObj:=wBelt;")
                points = f"Offs(pPart,0,{0.8 * r:.1f},60),Offs(pPart,{r:.1f},0,60)"
                lines.append(rf"MoveC {points},{how()}\WObj:=wBelt;")
            if say.random() < 0.3:
                lines.append(f"WaitTime {say.uniform(0, 0.3):.2f};")
        lines.append(
            say.choice(
                (
                    f"MoveL Offs(pWait,100,-100,50),{how()};",
                    f"MoveJ pBox,{how()};",
                    "MoveAbsJ jHome,v1000,fine,tGrip;",
                )
            )
        )
        lines.append("DropWObj wBelt;")
    return "\n".join(lines)


def trajectory_of(run: Run) -> Trajectory:
    return run.simulation.robots[0].trajectory


def largest_shares(run: Run) -> tuple[float, float]:
    """The largest shares of speeds and torques that the arm uses."""
    robot, trajectory = run.simulation.robots[0].robot, trajectory_of(run)
    times = np.arange(0.0, trajectory.duration + 0.1, _STEP_S)
    samples = trajectory.at(times)
    load = np.zeros(len(times))
    for piece in trajectory.pieces:
        for number, segment in piece.numbered:
            load[samples.move == number] = segment.load
    limits = limits_of(robot, run.simulation.model)
    speeds, torques = limit_shares(samples, robot.kinematics, limits, load, np.ones(len(times)))
    return float(speeds.max()), float(torques.max())


@pytest.mark.parametrize("seed", some(range(64), 16))
def test_random_moves_on_belts_keep_the_limits_and_have_no_jumps(seed: int, tmp_path: Path) -> None:
    """The largest share of 400 programs is 1.02; rounding of a hasty corner is in it."""
    say = random.Random(seed)
    speed = say.choice((50.0, 100.0, 200.0, 300.0, 400.0))
    run = run_of(tmp_path, random_body(say), station(speed, say.uniform(-0.6, 0.6)))
    speed, torque = largest_shares(run)
    assert speed < 1.03
    assert torque < 1.03
    assert not [one for one in run.diagnostics if one.code == "R132"]


def test_a_move_begun_too_fast_for_its_corner_is_not_slowed_down_in_vain(tmp_path: Path) -> None:
    """Slower plans of a move that the arm is braking in ask for more: 1.9 times its torque here."""
    body = r"""
    SetDO doRun,0;
    MoveJ pWait,v2000,z20,tGrip;
    SetDO doRun,1;
    WaitWObj wBelt\RelDist:=220;
    MoveL Offs(pPart,-23.1,11.7,80.8),vmax,z20,tGrip\WObj:=wBelt;
    WaitTime 0.15;
    SetDO doRun,0;
    MoveL Offs(pWait,100,-100,50),v2000,z10,tGrip;
    DropWObj wBelt;
    MoveJ pWait,vmax,z10,tGrip;
    SetDO doRun,1;
    WaitWObj wBelt\RelDist:=184;
    MoveJ Offs(pPart,-11.5,-33.1,86.3),v400,z50,tGrip\WObj:=wBelt;
    WaitTime 0.24;
    MoveL Offs(pWait,100,-100,50),v800,z1,tGrip;
    DropWObj wBelt;
"""
    run = run_of(tmp_path, body, station(50.0, 0.0478, more="maximum = 1200"))
    assert largest_shares(run)[1] < 1.3


_DRAWING = r"""
    MoveJ pWait,v1000,fine,tGrip;
    WaitWObj wBelt\RelDist:=100;
    MoveL Offs(pPart,0,0,60),v800,z10,tGrip\WObj:=wBelt;
    MoveL pPart,v400,fine,tGrip\WObj:=wBelt;
    WaitTime 0.3;
    MoveL Offs(pPart,60,0,0),v200,fine,tGrip\WObj:=wBelt;
    MoveC Offs(pPart,30,30,0),Offs(pPart,0,0,0),v200,fine,tGrip\WObj:=wBelt;
    here:=CRobT(\Tool:=tGrip\WObj:=wBelt);
    MoveL Offs(pPart,0,0,60),v400,z10,tGrip\WObj:=wBelt;
    MoveL pWait,v800,fine,tGrip;
    DropWObj wBelt;
"""


@pytest.mark.parametrize("smoothing", ["path", "axes"])
def test_the_tcp_is_on_its_curve_on_the_belt(smoothing: str, tmp_path: Path) -> None:
    """At an object 20 mm behind zero of the belt; its frame is (10, 20, 0) on it."""
    angle = 0.4
    run = run_of(tmp_path, _DRAWING, station(100.0, angle, smoothing))
    assert run.end == "ended", run.diagnostics
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    across = np.array([-np.sin(angle), np.cos(angle), 0.0])
    switch = np.array([-0.3 * np.cos(angle), 0.6 - 0.3 * np.sin(angle), 0.4])
    part = switch + (0.010 - 0.1 * 0.2) * along + 0.020 * across + np.array([0.0, 0.0, 0.08])
    trajectory = trajectory_of(run)
    steps = run.simulation.robots[0].moves
    settled = trajectory.seen_s(0.0) + 0.02
    for number, point in ((2, part), (3, part + 0.06 * along), (4, part)):
        end_s = steps[number].end_s + settled
        until_s = steps[number + 1].start_s
        times = np.linspace(min(end_s, until_s), until_s, 5)
        travel = 0.1 * times[:, None] * along
        seen = trajectory.at(times).base_from_tcp.translation - travel
        assert np.abs(seen - point).max() < 1e-6
    line = np.arange(steps[3].start_s, steps[3].end_s, _STEP_S)
    seen = trajectory.at(line).base_from_tcp.translation - 0.1 * line[:, None] * along - part
    off = np.hypot(seen @ across, seen[:, 2])
    assert off.max() < (1e-6 if smoothing == "path" else 5e-5)
    arc = np.arange(steps[4].start_s, steps[4].end_s, _STEP_S)
    seen = trajectory.at(arc).base_from_tcp.translation - 0.1 * arc[:, None] * along - part
    radius = np.hypot(seen @ along - 0.03, seen @ across)
    assert np.abs(radius - 0.03).max() < (1e-6 if smoothing == "path" else 2e-3)


@pytest.fixture(scope="module")
def changing(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """A belt that stops while the arm rests on it, and starts while the arm moves on it."""
    body = r"""
    MoveJ pWait,v1000,fine,tGrip;
    WaitWObj wBelt\RelDist:=100;
    MoveL pPart,v400,fine,tGrip\WObj:=wBelt;
    WaitTime 0.1;
    SetDO doRun,0;
    WaitTime 0.6;
    here:=CRobT(\Tool:=tGrip\WObj:=wBelt);
    TPWrite ValToStr(here.trans);
    MoveL Offs(pPart,100,0,0),v100,z1,tGrip\WObj:=wBelt;
    WaitTime 0.3;
    SetDO doRun,1;
    MoveL pPart,v100,fine,tGrip\WObj:=wBelt;
    MoveL pWait,v800,fine,tGrip;
    DropWObj wBelt;
    MoveL Offs(pWait,0,0,20),v800,fine,tGrip;
"""
    return run_of(tmp_path_factory.mktemp("changing"), body, station(200.0, more="maximum = 800"))


def test_an_arm_follows_a_belt_that_stops_and_starts_without_a_jump(changing: Run) -> None:
    """It is on the belt again 0.3 s later."""
    assert changing.end == "ended", changing.diagnostics
    trajectory = trajectory_of(changing)
    (belt,) = changing.simulation.belts
    stopped_s = belt.speeds[1][0]
    times = np.arange(stopped_s - 0.05, stopped_s + 0.5, _STEP_S)
    seen = trajectory.at(times).base_from_tcp.translation[:, 0]
    accelerations = np.diff(seen, n=2) / _STEP_S**2
    assert np.abs(accelerations).max() < 4.0 * 0.2 / 0.3 * 1.01
    after = times > stopped_s + 0.31
    assert np.ptp(seen[after]) < 1e-9
    assert seen[after][0] == pytest.approx(seen[0] + 0.2 * 0.05, abs=1e-9)


def test_a_position_on_the_belt_is_that_of_the_object(changing: Run) -> None:
    (text,) = (one.message for one in changing.events if one.message.startswith("["))
    x, y, z = (float(part) for part in text.strip("[]").split(","))
    assert (x, y, z) == pytest.approx((0.0, 0.0, 80.0), abs=0.01)


def test_reports_say_where_the_belt_is(changing: Run, tmp_path: Path) -> None:
    record = changing.as_json()
    (belt,) = record["conveyors"]
    assert belt["unit"] == "CNV1"
    assert [speed["speed_mm_s"] for speed in belt["speeds"]] == [200.0, 0.0, 200.0]
    stood_s = belt["speeds"][2]["time_s"] - belt["speeds"][1]["time_s"]
    assert belt["travel_mm"] == pytest.approx(200.0 * (changing.time_s - stood_s), abs=1e-6)
    assert [move.get("conveyor") for move in record["moves"]] == [
        *(None, "CNV1", "CNV1", "CNV1", None, None),
    ]
    rows = changing.trace(tmp_path / "trace.csv", dt=0.1).read_text().splitlines()
    assert rows[0].endswith(",tcp_speed_mm_s,c1_mm")
    assert float(rows[2].rpartition(",")[2]) == pytest.approx(20.0)


def test_a_path_that_is_cleared_on_a_belt_leaves_the_arm_where_it_is(tmp_path: Path) -> None:
    """Half on the belt it drifts until the next move, without a jump; no path is stored there."""
    body = r"""
    MoveJ pWait,v1000,fine,tGrip;
    WaitWObj wBelt\RelDist:=100;
    MoveL\Conc,pPart,v100,z10,tGrip\WObj:=wBelt;
    WaitTime 0.4;
    StopMove;
    ClearPath;
    StartMove;
    WaitTime 0.2;
    MoveL Offs(pPart,50,0,0),v100,fine,tGrip\WObj:=wBelt;
    StorePath;
"""
    run = run_of(tmp_path, body, station(100.0))
    assert run.error is not None
    assert "StorePath" in run.error.message
    trajectory = trajectory_of(run)
    times = np.arange(0.0, trajectory.duration, _STEP_S)
    assert np.abs(np.diff(trajectory.at(times).joints, n=2, axis=0)).max() < 1e-4


def test_an_arm_goes_from_one_belt_to_another(tmp_path: Path) -> None:
    """The second runs the other way; at both stop points the TCP is at its target on the belt."""
    (tmp_path / "belts.mod").write_text(
        _DATA.replace(
            "  PROC main()",
            '  PERS wobjdata wTo:=[FALSE,FALSE,"CNV2",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
            "  CONST robtarget pPut:="
            "[[0,0,80],[0,1,0,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main()",
        )
        + r"""
    MoveJ pWait,v1000,fine,tGrip;
    WaitWObj wBelt\RelDist:=200;
    MoveL pPart,v800,fine,tGrip\WObj:=wBelt;
    WaitWObj wTo\RelDist:=100;
    MoveL Offs(pPut,0,0,30),v800,z10,tGrip\WObj:=wTo;
    MoveL pPut,v400,fine,tGrip\WObj:=wTo;
    here:=CRobT(\Tool:=tGrip\WObj:=wTo);
    TPWrite ValToStr(here.trans);
    MoveJ pWait,v1000,fine,tGrip;
  ENDPROC
ENDMODULE
"""
    )
    other = '\n[[conveyor]]\nunit = "CNV2"\nspeed = 200\nat = 0.5\nevery = 1\nlength = 600\n'
    other += "maximum = 900\nposition = [700, 500, 400]\nquaternion = [0, 0, 0, 1]\n"
    (tmp_path / "rapidsim.toml").write_text(station(150.0) + other)
    run = rapidsim.load(tmp_path).run()
    assert run.end == "ended", run.diagnostics
    assert not [one for one in run.diagnostics if one.severity == "error"]
    assert "[0,0,80]" in [event.message for event in run.events]
    trajectory = trajectory_of(run)
    times = np.arange(0.0, trajectory.duration, _STEP_S)
    assert np.abs(np.diff(trajectory.at(times).joints, n=2, axis=0)).max() < 1e-4


def test_an_arm_that_has_left_a_belt_is_off_it_to_the_last_bit(changing: Run) -> None:
    """However the weight at the end of the path is rounded."""
    numbered = (pair for piece in trajectory_of(changing).pieces for pair in piece.numbered)
    segment = next(one for _, one in numbered if one.rides and one.rides[0].end == 0.0)
    say = random.Random(0)
    for _ in range(1000):
        start = say.uniform(0.0, 3.0)
        end = start + say.uniform(0.1, 1.0)
        ride = replace(segment.rides[0], zones=(say.uniform(0.001, 0.05), 0.0))
        leaving = replace(segment, rides=(ride,))
        offsets = belt_offsets((leaving,), np.array([start, end]))
        assert offsets is not None
        assert not offsets.riding(0, end)
        assert offsets.riding(0, start)


def test_a_check_finds_targets_that_a_belt_takes_nowhere_within_reach(tmp_path: Path) -> None:
    """Main ends before the moves, so that no run tells."""
    body = r"""
    WaitUntil FALSE;
    MoveL pPart,v400,fine,tGrip\WObj:=wBelt;
    MoveL Offs(pPart,0,0,1500),v400,fine,tGrip\WObj:=wBelt;
"""
    (tmp_path / "rapidsim.toml").write_text(station(200.0))
    (tmp_path / "belts.mod").write_text(f"{_DATA}{body}\n  ENDPROC\nENDMODULE\n")
    found = [one for one in rapidsim.load(tmp_path).check().diagnostics if one.code == "K601"]
    assert len(found) == 1
    assert "all along 420 mm" in found[0].message


def test_a_move_that_is_slowed_down_for_a_belt_says_so(tmp_path: Path) -> None:
    """On 20 mm of way the arm has to catch up with 400 mm/s."""
    body = r"""
    MoveJ pWait,v1000,fine,tGrip;
    WaitWObj wBelt\RelDist:=100;
    here:=CRobT(\Tool:=tGrip\WObj:=wBelt);
    MoveL Offs(here,0,0,-20),vmax,fine,tGrip\WObj:=wBelt;
    MoveJ pWait,v1000,fine,tGrip;
"""
    run = run_of(tmp_path, body, station(400.0))
    assert [move.limit for move in run.moves][1] == "belt that the arm follows"
