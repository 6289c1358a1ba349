"""World zones where one instant is rounded otherwise than the same instant among many."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.controller.queue.zone_table import WatchedZone, WorldZoneTable
from rapidsim.frames.transform import Array
from rapidsim.jobs.running.run_files import simulate
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.simulation.options import RunOptions

PROGRAM = """MODULE border
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR wzstationary zone;
  PROC watch()
    VAR shapedata box;
    WZBoxDef\\Inside,box,[0,-900,700],[900,900,1500];
    WZDOSet\\Stat,zone\\Inside,box,doHigh,1;
  ENDPROC
  PROC main()
    watch;
    MoveJ p1,v500,fine,tool0;
    MoveL Offs(p1,0,0,200),v500,fine,tool0;
    MoveL p1,v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("alone", [-1e-7, 1e-7])
def test_a_border_is_crossed_once_however_it_is_rounded(
    alone: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    exact = WorldZoneTable._inside

    def rounded(table: WorldZoneTable, zone: WatchedZone, samples: Samples) -> Array:
        if len(samples.times) == 1:
            samples.base_from_tcp.translation[:, 2] += alone
        return exact(table, zone, samples)

    monkeypatch.setattr(WorldZoneTable, "_inside", rounded)
    (tmp_path / "border.mod").write_text(PROGRAM)
    run = simulate(
        [tmp_path / "border.mod"],
        robot="irb1600",
        options=RunOptions(home=tmp_path, max_wall_s=20.0),
    )
    edges = [one.time_s for one in run.events if one.message.startswith("doHigh")]
    assert run.end == "ended"
    assert len(edges) == 4  # It starts in the zone.
    heights = run.robots[0].trajectory.at(np.array(edges[1:])).base_from_tcp.translation[:, 2]
    assert heights == pytest.approx([0.7, 0.7, 0.7], abs=1e-5)
