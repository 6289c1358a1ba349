"""Where a program of many moves loses time: stretches below the programmed speed, and comments."""

from pathlib import Path

import pytest

import rapidsim
from rapidsim.controller.journal.events import Wait
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.simulation.results.regions import by_comment
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.slow_sections import slow_lines, slow_sections

PROGRAM = """MODULE parts
  CONST robtarget p:=[[700,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    ConfL\\Off;
    MoveJ p, v1000, fine, tool0;
    ! --- Long line at a speed that is reached ---
    ! (a second line of the same comment)
    MoveL Offs(p,0,400,0), v100, fine, tool0;
    WaitTime 2;

    ! Short stitches, too short for their speed
    FOR k FROM 1 TO 20 DO
      MoveL Offs(p,0,400-5*k,0), v1000, fine, tool0;
    ENDFOR
    ! rapidsim: ignore[S9]
    turn;
  ENDPROC
  PROC turn()
    MoveL RelTool(Offs(p,0,300,0),0,0,0\\Rz:=60), [1000,20,1000,1000], fine, tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    program = tmp_path_factory.mktemp("held") / "parts.mod"
    program.write_text(PROGRAM)
    return rapidsim.simulate([program], robot="irb1600")


def test_a_stretch_names_lines_time_and_limit(run: Simulation) -> None:
    found = slow_sections(run)
    assert [one.lost_s for one in found] == sorted((one.lost_s for one in found), reverse=True)
    # The turn alone: its TCP does not travel, the reorientation speed holds it all the way.
    turn = max(found, key=lambda one: one.seconds)
    assert (turn.first.place.routine, turn.limit) == ("turn", "reorientation speed")
    assert turn.seconds == pytest.approx(3.0, abs=0.4)
    stitches = [one for one in found if one.first.place.span.line == 14]
    assert len(stitches) == 1
    assert stitches[0].moves == 20
    assert "torque of axis" in stitches[0].limit
    assert stitches[0].reached_mm_s < 300.0 < stitches[0].programmed_mm_s


def test_the_passes_of_a_loop_are_one_row(tmp_path: Path) -> None:
    program = tmp_path / "loop.mod"
    passes = "FOR i FROM 1 TO 4 DO\n"
    program.write_text(
        PROGRAM.replace("PROC main()\n", "PROC main()\n" + passes, 1).replace(
            "ENDPROC", "ENDFOR\nENDPROC", 1
        )
    )
    run = rapidsim.simulate([program], robot="irb1600")
    sections, lines = slow_sections(run), slow_lines(run)
    assert len(lines) < len(sections)
    keys = [(one.first.place.span.line, one.last.place.span.line, one.limit) for one in sections]
    assert len(lines) == len(set(keys))
    for of in ("seconds", "lost_s", "moves"):
        both = [sum(getattr(one, of) for one in found) for found in (sections, lines)]
        assert both[0] == pytest.approx(both[1])
    assert [one.lost_s for one in lines] == sorted((one.lost_s for one in lines), reverse=True)
    assert max(one.programmed_mm_s for one in lines) >= max(one.reached_mm_s for one in lines)


def test_where_the_speed_is_reached_only_ramps_are_lost(run: Simulation) -> None:
    line = [one for one in slow_sections(run) if one.first.place.span.line == 9]
    assert sum(one.seconds for one in line) < 0.5
    assert all(one.programmed_mm_s == pytest.approx(100.0) for one in line)


def test_time_is_added_up_by_comment(run: Simulation) -> None:
    regions = by_comment(run.moves, run.waits)
    said = {one.line: (one.comment, one.steps) for one in regions}
    # The first move stands before any comment, and a suppression heads nothing.
    assert said[7] == ("Long line at a speed that is reached", 2)
    assert said[12] == ("Short stitches, too short for their speed", 20)
    assert set(said) == {7, 12}
    (first,) = (one for one in regions if one.line == 7)
    steps: list[ExecutedMove | Wait] = [*run.moves, *run.waits]
    took_s = sum(one.end_s - one.start_s for one in steps if one.place.span.line in (9, 10))
    assert first.seconds == pytest.approx(took_s)
    assert Path(first.file).name == "parts.mod"
