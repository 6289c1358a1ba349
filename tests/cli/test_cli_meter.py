"""The line that says how far a long run is, at instants of a clock that the test holds."""

from collections.abc import Iterator

import pytest

from rapidsim.cli.tools.progress_meter import Meter
from rapidsim.simulation.progress import Progress


@pytest.mark.parametrize(
    ("written", "seconds", "progress", "line"),
    [
        (1000, 0.5, Progress(5, 5, 9), "simulating ..."),
        (1000, 2.0, None, "simulating ..."),
        (1000, 2.0, Progress(250, 250, 9), "simulating: 25 %, 250 moves, 125 a second, 6 s left"),
        (
            100_000,
            60.0,
            Progress(20_000, 20_000, 9),
            "simulating: 20 %, 20,000 moves, 333 a second, 4 min 0 s left",
        ),
        # What a loop repeats, no text tells the end of; nor the first moves.
        (10, 10.0, Progress(500, 10, 9), "simulating: 500 moves, 50 a second"),
        (100_000, 2.0, Progress(3, 3, 9), "simulating: 3 moves, 2 a second"),
        (
            2000,
            70.0,
            Progress(1, 1, 1500),
            "simulating: planning 1,500 moves as one path, 1 min 10 s so far",
        ),
        (0, 2.0, Progress(0, 0, 9), "simulating: 0 moves, 0 a second"),
    ],
)
def test_the_line_says_what_is_known(
    written: int, seconds: float, progress: Progress | None, line: str
) -> None:
    instants: Iterator[float] = iter([100.0, 100.0 + seconds])
    meter = Meter(written, now=lambda: next(instants))
    if progress is not None:
        meter.read(lambda: progress)
    assert meter.__rich__().plain == line
