"""Fourteen faults of different families in one program: all are found, and nothing else."""

from __future__ import annotations

import os
import re
from pathlib import Path

from check_helper import HERE, found_in
from command_line import call

PLANTED = HERE / "planted"
PROGRAM = PLANTED / "welding_cell.mod"
# Code, and the text that the finding points at.
FAULTS = [
    ("M508", "tTorch"),
    ("M501", "[0,0.7,0.7,0]"),
    ("M511", "9"),
    ("T305", "[[0,150,120],[0,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
    ("I802", "WaitDI"),
    ("T307", "rest(nDone)=0.1"),
    ("T301", "1"),
    ("F401", "MoveJ pPick,v200,fine,tTorch\\WObj:=wTable"),
    ("M502", "z50"),
    ("N201", "pPcik"),
    ("E103", ""),
    ("F408", "TRYNEXT"),
    ("T302", "MoveL Offs(pSeam,0,10*seam,0),v100,tTorch\\WObj:=wTable"),
    ("F404", "ENDFUNC"),
]


def test_all_faults_and_only_those_are_found_where_they_are() -> None:
    found = [(one.violation.code, one.span.text) for one in found_in(PROGRAM) if one.span]
    assert found == FAULTS


def test_the_text_is_as_beautiful_as_it_was() -> None:
    done = call("check", PROGRAM.name, "--no-reach", cwd=PLANTED, columns=100)
    text = re.sub(r"\(\d+\.\d\d s\)", "(0.00 s)", done.out)
    golden = Path(PLANTED / "welding_cell.txt")
    if os.environ.get("UPDATE_GOLDEN"):
        golden.write_text(text, encoding="utf-8")
    assert done.code == 1
    assert text == golden.read_text(encoding="utf-8")
