"""Strictness rejects programs of the book only for what is not simulated or not checked."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from laws import some
from rapid_promises import promised, sources
from test_rapid_book import PROGRAMS, name

import rapidsim
from rapidsim.jobs.running.run_files import ProgramRejectedError
from rapidsim.simulation.results.verdict import run_verdict

RESERVATIONS = {
    "motion/arc_welding": "3 routines not simulated",
    "motion/arc_welding_left_out": "1 routine not simulated",
    "motion/arc_welding_on_a_circle": "3 routines not simulated",
    "motion/contact_and_lead_through": "2 routines not simulated",
    "motion/search_of_a_groove": "1 routine not simulated",
    "motion/search_with_the_torch": "1 routine not simulated",
    "motion/spot_welding": "4 routines not simulated",
    "system/data_of_options": "1 routine not simulated",
    "system/facts_of_the_system": "1 routine not simulated",
    "system/pointer_not_moved": "1 routine not simulated",
    "newer/pick_and_place": "1 routine not simulated",
}
"""Programs that only a strict check rejects, and why."""
TOLD_BY_A_RUN = {"R104", "I801", "N220"}
TOLD_IN_HEADLINE = ("ended early", "not in the stored configuration")
CASES = sorted({*some(PROGRAMS, 16), *(one for one in PROGRAMS if name(one) in RESERVATIONS)})


@pytest.mark.parametrize("program", CASES, ids=name)
def test_strictness_adds_no_other_rejection(
    program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = tmp_path / "home"
    if (program / "home").is_dir():
        shutil.copytree(program / "home", home)
    else:
        home.mkdir()
    cell = rapidsim.load(program, home=home, strict=True)
    monkeypatch.chdir(tmp_path)
    found = cell.check()
    is_added = replace(found, strict=False).ok and not found.ok
    assert is_added is (name(program) in RESERVATIONS), found.qualifications
    if is_added:
        assert "; ".join(found.qualifications) == RESERVATIONS[name(program)]
    try:
        run = cell.run(max_time_s=60.0)
    except ProgramRejectedError:
        return
    if run_verdict(replace(run.simulation, strict=False)).ok and not run.ok:
        told = {text for *_, kind, text in promised(sources(program)) if kind == "warning"}
        is_in_headline = any(text in run.headline for text in TOLD_IN_HEADLINE)
        assert told & TOLD_BY_A_RUN or is_in_headline, run.headline
