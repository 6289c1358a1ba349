"""System outputs that tell of each robot whether it stands."""

from pathlib import Path

import pytest
from simulation_tasks import ran

from rapidsim.station.cell_names import declared_names
from rapidsim.station.read import read_io
from rapidsim.station.station import Station


def test_system_outputs_show_which_robots_stand(tmp_path: Path) -> None:
    file = tmp_path / "io.toml"
    file.write_text(
        """
        [signals]
        left_stands = { type = "do", system = "MechUnitNotMoving" }
        right_stands = { type = "do", system = "MechUnitNotMoving", unit = "ROB_2" }
        right_active = { type = "do", system = "MechUnitActive", unit = "ROB_2" }
        """
    )
    target = "[[{},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200"
    it = ran(
        {
            "T_ROB1": f"""PROC main()
              WaitTime 0.5;
              MoveAbsJ {target.format(20)}, z10, tool0;
              MoveAbsJ {target.format(40)}, fine, tool0;
              TPWrite "left there";
              WaitTime 1;
              MoveAbsJ {target.format(40)}, fine, tool0;
              WaitTime 3;
            ENDPROC""",
            "T_ROB2": f"""PROC main()
              WaitDO left_stands, 0;
              TPWrite "left moves";
              WaitDO left_stands, 1;
              TPWrite "left stands";
              IF right_active = 1 AND right_stands = 1 MoveAbsJ {target.format(9)}, z10, tool0;
            ENDPROC""",
        },
        robots=("T_ROB1", "T_ROB2"),
        cell=declared_names(Station(io=read_io(file))),
        io=read_io(file),
    )
    ((begun_s, _), (there_s, _), (stood_s, _)) = it.texts
    assert [text for _, text in it.texts] == ["left moves", "left there", "left stands"]
    assert (begun_s, stood_s) == (0.5, there_s)
    right = [(time_s, text) for time_s, _, text in it.events if "right_stands" in text]
    assert [text for _, text in right] == ["right_stands = 0", "right_stands = 1"]
    (move,) = it.moves("T_ROB2")
    assert [time_s for time_s, _ in right] == pytest.approx([stood_s, move.end_s], abs=1e-3)
