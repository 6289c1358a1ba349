"""Searches with the torch of a part that the station has displaced."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

import rapidsim

_WAYS = ((30, 0, 0), (0, -25, 0), (0, 0, 40))
_HEAD = """MODULE m
  VAR robtarget p;
  VAR pose found:=[[0,0,0],[1,0,0,0]];
  VAR pose one;
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    p:=CRobT();
"""
millimetres = st.floats(-12.0, 12.0).map(lambda x: round(x, 3))


def run(statements: str, displaced: tuple[float, ...]) -> rapidsim.Run:
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "m.mod"
        program.write_text(f"{_HEAD}{statements}\nENDPROC\nENDMODULE\n")
        station = f'[robot]\nmodel = "irb1600-6-1.2"\n[[search]]\nposition = {list(displaced)}\n'
        (Path(folder) / "rapidsim.toml").write_text(station)
        return rapidsim.load(program).run()


@given(st.tuples(millimetres, millimetres, millimetres))
@examples(12)
def test_searches_in_three_directions_find_the_displacement(
    displaced: tuple[float, float, float],
) -> None:
    searches = "\n".join(
        f"Search_1D found,Offs(p,{x},{y},{z}),p,v100,tool0\\PrePDisp:=found;" for x, y, z in _WAYS
    )
    it = run(f"{searches}\nPDispSet found;\nMoveL p,v100,fine,tool0;", displaced)
    assert it.end == "ended"
    assert not it.simulation.unsimulated
    assert list(it.data["found"].trans) == pytest.approx(displaced, abs=2e-3)
    arrived = it.trajectory.at(it.time_s).position_mm
    there = np.asarray(arrived) - np.asarray(it.data["p"].trans)
    assert there == pytest.approx(displaced, abs=2e-3)


@given(st.tuples(millimetres, millimetres, millimetres), st.sampled_from(_WAYS))
@examples(12)
def test_a_search_finds_what_lies_along_it(
    displaced: tuple[float, float, float], way: tuple[int, int, int]
) -> None:
    x, y, z = way
    it = run(f"Search_1D one,Offs(p,{x},{y},{z}),p,v100,tool0;", displaced)
    along = [d if w else 0.0 for d, w in zip(displaced, way, strict=True)]
    assert list(it.data["one"].trans) == pytest.approx(along, abs=2e-3)


@pytest.mark.parametrize(
    ("displaced", "message"),
    [
        ((0, 0, -41), "finds nothing within 80.0 mm, twice the distance between its points"),
        ((0, 0, 45), "touches the part at the start point, 5.0 mm deep"),
    ],
)
def test_a_search_that_fails_says_by_how_much(displaced: tuple[float, ...], message: str) -> None:
    it = run("Search_1D one,Offs(p,0,0,40),p,v100,tool0;", displaced)
    (found,) = [one for one in it.diagnostics if one.code == "R101"]
    assert message in found.message


def test_a_result_beyond_the_limit_is_kept_and_reported() -> None:
    it = run("Search_1D one,Offs(p,0,0,40),p,v100,tool0\\Limit:=5;", (0, 0, -8))
    assert [one.name for one in it.simulation.unsimulated] == ["Search_1D beyond its \\Limit"]
    assert it.data["one"].trans.z == pytest.approx(-8.0, abs=2e-3)
