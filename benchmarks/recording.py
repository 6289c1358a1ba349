"""How fast a recording is written and how big it gets; and the report of a long path.

    python benchmarks/recording.py

Prints rows a second, bytes a second of motion, the size of an hour under way, and the pentagon's.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from rerun.chunk import RrdReader

import rapidsim
from rapidsim.recording import samples as sampled
from rapidsim.recording.layout import write
from rapidsim.report.html.write import write_report
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation

ROOT = Path(__file__).parents[1]
ROUNDS = 400
ARC_MOVES = 10_000
ROUND = """MODULE Rounds
  PROC main()
    VAR robtarget p:=[[600,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    ConfL\\Off;
    ConfJ\\Off;
    FOR n FROM 1 TO {rounds} DO
      MoveJ Offs(p,n/100,0,0), v500, z10, tool0;
      MoveL Offs(p,0,400+n/50,0), v1000, z50, tool0;
      MoveL Offs(p,0,400,-300), v500, fine, tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""
SPIRAL = """MODULE Spiral
  PROC main()
    VAR num a;
    ConfL\\Off;
    ConfJ\\Off;
    MoveJ [[750,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
    FOR k FROM 1 TO {moves} DO
      a:=3*k;
      MoveL [[700+50*Cos(a),50*Sin(a),500+k/50],[0,0,1,0],[0,0,0,0],
        [9E9,9E9,9E9,9E9,9E9,9E9]], v200, z1, tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""


def main() -> None:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        recording_of_an_hour(scratch)
        options = RunOptions(home=scratch, answers=lambda _: "30")
        pentagon = rapidsim.simulate(
            [ROOT / "programs" / "pentagon.mod"], robot="irb1600", options=options
        )
        size = write.record(pentagon, scratch / "pentagon.rrd").stat().st_size
        print(f"pentagon: {size / 1e6:.2f} MB")
        report_of_a_long_path(scratch)


def recording_of_an_hour(scratch: Path) -> float:
    """How large [MB] the recording of an hour under way is; measured on less."""
    return _recording(_run(scratch, ROUND.format(rounds=ROUNDS)), scratch)


def report_of_a_long_path(scratch: Path) -> float:
    """How large [MB] the report of 10,000 moves is."""
    return _report(_run(scratch, SPIRAL.format(moves=ARC_MOVES)), scratch)


def _run(scratch: Path, text: str) -> Simulation:
    program = scratch / "program.mod"
    program.write_text(text)
    start = time.perf_counter()
    simulation = rapidsim.simulate([program], robot="irb1600", max_time=3600.0)
    print(
        f"{len(simulation.moves)} moves, {simulation.time_s:.0f} s, {simulation.end.value}", end=""
    )
    print(f", simulated in {time.perf_counter() - start:.1f} s")
    return simulation


def _recording(simulation: Simulation, scratch: Path) -> float:
    start, busy = time.perf_counter(), time.thread_time()
    runs = sampled.sample(simulation, None)
    sampling_s, sampling_busy_s = time.perf_counter() - start, time.thread_time() - busy
    path = scratch / "rounds.rrd"
    start, busy = time.perf_counter(), time.thread_time()
    write.record(simulation, path)
    writing_s = time.perf_counter() - start - sampling_s
    # What this thread itself worked, which other programs on the machine do not lengthen.
    working_s = time.thread_time() - busy - sampling_busy_s
    rows = sum(chunk.num_rows for chunk in RrdReader(path).stream())
    samples = len(runs[0].samples.times)
    size = path.stat().st_size
    print(f"recording: {samples} samples in {sampling_s:.2f} s ({samples / sampling_s:,.0f}/s)")
    print(f"recording: {rows} rows in {writing_s:.2f} s ({rows / writing_s:,.0f}/s)", end="; ")
    print(f"{rows / working_s:,.0f}/s of the thread's own time")
    print(f"recording: {size / 1e6:.1f} MB, {size / samples:.0f} bytes a sample", end="; ")
    hour = size / samples * sampled.MOST_SAMPLES / 1e6
    print(f"an hour under way: {hour:.0f} MB")
    return hour


def _report(simulation: Simulation, scratch: Path) -> float:
    start = time.perf_counter()
    path = write_report(simulation, simulation.diagnostics, scratch / "report.html")
    took_s = time.perf_counter() - start
    megabytes = path.stat().st_size / 1e6
    print(f"report of {len(simulation.moves)} moves: {megabytes:.2f} MB in {took_s:.1f} s")
    return megabytes


if __name__ == "__main__":
    main()
