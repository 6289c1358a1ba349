"""Programs that use the library through parser, checker and interpreter."""

import re
from pathlib import Path

import pytest
from library_controller import RecordingController

from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Source
from rapidsim.interpreter.linking.loader import load
from rapidsim.language.errors import CycleEnded
from rapidsim.syntax.parser import parse

PROGRAMS = sorted(Path(__file__).with_name("programs").glob("*.mod"))


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_program_writes_what_its_comments_say(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    parsed = parse(Source(path.name, text))
    checked = check([parsed.file])
    assert [d.violation.message for d in (*parsed.diagnostics, *checked.diagnostics)] == []
    assert checked.program is not None
    controller = RecordingController()
    # Every program here ends with ExitCycle, which no ERROR clause may catch.
    with pytest.raises(CycleEnded):
        load(checked.program, controller.whole()).run()
    written = [line.removeprefix("show ") for line in controller.log if line.startswith("show ")]
    assert written == re.findall(r"! -> (.*)", text)
    assert not controller.unsimulated
