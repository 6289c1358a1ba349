"""What small programs do to their ends: texts, time, errors, answers of clauses.

A section of `runs.txt` holds statements of main, and behind `||` other items of the module.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from interpreter_cell import RecordingController, main, run
from test_interpreter_python import DATA
from whole_findings import assert_section, sections

HERE = Path(__file__).parent
PROGRAMS = sections(HERE / "runs.txt")


def told(section: str) -> Iterator[str]:
    body, _, more = section.partition("|| ")
    controller = RecordingController(max_slices=20)
    ran = run(main(body, DATA, more), controller=controller, assumes=True)
    yield from (f"  {one}" for one in controller.texts)
    yield f"{controller.slices} slices, {controller.waited_s:g} s"
    for routine, treated_as in controller.skipped:
        yield f"{routine} {treated_as}"
    for answer in controller.answers:
        yield f"{answer.name} at {answer.raised}, {answer.outcome} at {answer.clause}"
    if ran.fatal is not None:
        yield f"error: {ran.fatal.error.message} ({ran.fatal.error.errno:g})"
        for frame in ran.fatal.stack[:4]:
            written = frame.source.text[frame.start : frame.end]
            yield f"  {frame.routine} {frame.clause}: {written}"
    if ran.stopped is not None:
        yield f"stopped: {ran.stopped.reason}"


@pytest.mark.parametrize("name", PROGRAMS)
def test_what_a_program_does(name: str) -> None:
    text = "".join(f"{line}\n" for line in told(PROGRAMS[name]))
    assert_section(HERE / "golden" / "runs.txt", name, text)
