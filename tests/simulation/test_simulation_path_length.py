"""The counter of the path length: what it counts is what the run has travelled."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from live_controller import Live, module
from simulation_program import ran

HOME = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
MOVES = st.tuples(
    st.sampled_from(["MoveL", "MoveJ"]),
    st.tuples(*[st.integers(-80, 80)] * 3),
    st.sampled_from(["z1", "z10", "z50", "fine"]),
    st.sampled_from(["v100", "v500", "vmax"]),
)


@given(st.lists(MOVES, min_size=1, max_size=6), st.booleans(), st.floats(0.1, 0.4))
@examples(40)
def test_all_that_is_travelled_is_counted_however_often_it_is_read(
    moves: list[tuple[str, tuple[int, int, int], str, str]], reads: bool, every_s: float
) -> None:
    body = [f"MoveAbsJ {HOME},v500,fine,tool0; p:=CRobT(); PathLengthStart;"]
    if reads:
        body.append(f"CONNECT underway WITH look; ITimer {every_s:.3f},underway;")
    body += [
        f"{move} Offs(p,{','.join(map(str, offset))}),{speed},{zone},tool0;"
        for move, offset, zone, speed in moves
    ]
    body.append("MoveL p,v500,fine,tool0; IDelete underway; TPWrite ValToStr(PathLengthGet());")
    text = module(
        "\n".join(body),
        "VAR robtarget p; VAR intnum underway; VAR num last;",
        """TRAP look
  ! It never falls.
  IF PathLengthGet()<last Stop;
  last:=PathLengthGet();
ENDTRAP""",
    )
    it = ran(text)
    assert it.end == "ended"
    assert float(it.texts[-1]) == pytest.approx(it.run.path_m * 1e3, rel=1e-5, abs=1e-3)


def test_a_controller_that_forgets_its_motion_has_counted_it() -> None:
    turns = 20
    live = Live(
        module(
            f"""MoveAbsJ {HOME},v500,fine,tool0;
            p:=CRobT();
            PathLengthStart;
            FOR i FROM 1 TO {turns} DO
              MoveL Offs(p,0,100,0),v100,fine,tool0;
              MoveL p,v100,fine,tool0;
            ENDFOR
            travelled:=PathLengthGet();
            WHILE TRUE DO
              WaitTime 1;
            ENDWHILE""",
            "VAR robtarget p; PERS num travelled:=0;",
        )
    )
    live.controller.start()
    for _ in range(70):
        live.after(1.0)
    assert float(live.value("travelled")) == pytest.approx(turns * 200.0, abs=1e-3)


def test_a_joint_move_counts_the_arc_of_the_tcp() -> None:
    quarter = module(
        f"""MoveAbsJ {HOME},v500,fine,tool0;
        PathLengthStart;
        MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
        TPWrite ValToStr(PathLengthGet());
        TPWrite ValToStr(CPos(\\Tool:=tool0\\WObj:=wobj0));"""
    )
    length, radius = ran(quarter).texts
    assert float(length) == pytest.approx(float(radius.split(",")[1]) * math.pi / 2.0, abs=0.01)
