"""TriggStopProc: what a stop of the program does to the signals of a process, and notes of them."""

import pytest
from live_controller import Live, module
from simulation_program import ran

from rapidsim.controller.journal.events import EventKind
from rapidsim.simulation.live import signals

DATA = "PERS restartdata restart:=[FALSE,FALSE,0,0,0,0,0,0,0,0,0,0,0,0,0];"
SET_UP = r"TriggStopProc restart\DO1:=doGlue\GO2:=goFlow,doShadow; SetDO doGlue,1; SetGO goFlow,5;"


@pytest.mark.parametrize("end", ["Stop;", "EXIT;", "a{n}:=1;"])
def test_a_run_that_stops_notes_its_signals_and_zeroes_them(end: str) -> None:
    text = f"""MODULE cell
  {DATA}
  VAR num n:=3;
  VAR num a{{2}};
  PROC main()
    {SET_UP} SetDO doShadow,1;
    {end}
  ENDPROC
ENDMODULE
"""
    it = ran(text)
    noted = "[TRUE,FALSE,1,1,-1,-1,5,5,-1,-1,-1,-1,1,0,1]"
    assert [one.new for one in it.run.persistents if one.name == "restart"] == [noted]
    assert [event.message for event in it.run.events if event.kind is EventKind.SIGNAL][-2:] == [
        "doGlue = 0",
        "goFlow = 0",
    ]


def test_a_stop_on_the_path_notes_them_before_and_after_and_counts_what_comes_between() -> None:
    live = Live(
        module(
            f"""{SET_UP} SetDO\\SDelay:=0.55,doShadow,1; SetDO\\SDelay:=0.55,doGlue,0;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v2000, fine, tool0;""",
            DATA,
        )
    )
    live.controller.start()
    live.after(0.5)
    live.controller.stop()
    assert live.value("restart").startswith("[FALSE")
    live.after(1.0)
    assert live.value("restart") == "[TRUE,TRUE,1,0,-1,-1,5,5,-1,-1,-1,-1,0,1,1]"
    assert signals.value_of(live.controller, "goFlow") == 0.0


@pytest.mark.parametrize("end", ["", "WaitDI diNever,1;"])
def test_a_run_in_which_nothing_stops_the_program_notes_nothing(end: str) -> None:
    it = ran(
        f"MODULE cell\n  {DATA}\n  PROC main()\n    {SET_UP}\n    {end}\n  ENDPROC\nENDMODULE\n"
    )
    assert "restart" not in {one.name for one in it.run.persistents}
    assert not [event for event in it.run.events if event.message == "doGlue = 0"]
