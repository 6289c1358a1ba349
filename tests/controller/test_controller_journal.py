"""What a run keeps of its statements and of moves that failed."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest
from plain_segments import plain_segment

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.journal.executed_lines import (
    DatedPlace,
    DatedRows,
    ExecutedLines,
    in_parts,
    times_of,
)
from rapidsim.controller.journal.failed_moves import failed_at_fraction, refused_axes
from rapidsim.diagnostics import Source, Span
from rapidsim.findings.runs import CutOff
from rapidsim.frames.transform import Transform
from rapidsim.language.moves import AnnouncedRow, AnnouncedTargets, Place
from rapidsim.motion.geometry.segments import Geometry, Speed, Waypoint
from rapidsim.motion.robot.robot import load_robot

TEXT = Source("m.mod", "0123456789" * 5)


class Targets:
    """Announced targets whose statements are a letter each."""

    def place(self, number: int) -> Place:
        targets = cast(AnnouncedTargets, self)
        return Place(Span(TEXT, number, number + 1), "main", row=AnnouncedRow(targets, number))


def single(at: int) -> Place:
    return Place(Span(TEXT, at, at + 2), "other")


def dated() -> list[DatedPlace]:
    """Two statements, three with announced targets, one of others, and one more alone."""
    one, other = Targets(), Targets()
    rows = [one.place(4), one.place(5), one.place(6), other.place(7), one.place(9)]
    return list(zip(np.arange(8.0), [single(0), single(2), *rows, single(30)], strict=True))


def test_successive_rows_are_columns_and_the_rest_is_as_it_was() -> None:
    lines = dated()
    parts = list(in_parts(lines))
    assert [len(part) for part in parts] == [2, 3, 1, 1, 1]
    assert [isinstance(part, DatedRows) for part in parts] == [False, True, True, True, False]
    for part, begin in zip(parts, (0, 2, 5, 6, 7), strict=True):
        for at, (time_s, place) in enumerate(part):
            assert (time_s, place) == lines[begin + at]
            row, wanted = place.row, lines[begin + at][1].row
            assert (row is None) is (wanted is None)
            if row is not None and wanted is not None:
                assert row.targets is wanted.targets
                assert row.number == wanted.number
    assert list(in_parts([])) == []


def test_statements_are_in_the_order_of_time_and_of_execution() -> None:
    lines = dated()
    late, early = [(9.0, place) for _, place in lines[:2]], lines[2:]
    made = ExecutedLines("T_ROB1", [late, *in_parts(early), [], [(2.0, single(40))]])
    assert len(made) == 9
    assert [line.time_s for line in made] == [2.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 9.0, 9.0]
    assert [line.place.span.start for line in made] == [4, 40, 5, 6, 7, 9, 30, 0, 2]
    assert {line.task for line in made} == {"T_ROB1"}
    assert times_of(made) is made.times
    assert times_of(list(made)).tolist() == made.times.tolist()
    assert len(ExecutedLines("T_ROB1", [])) == 0


def test_an_event_is_one_short_line() -> None:
    event = Event(1.5, "T_ROB1", EventKind.TEXT, None, "x" * 59)
    assert repr(event) == f"<text at 1.500 s of T_ROB1: {'x' * 59!r}>"
    event = Event(1.5, "T" * 30, EventKind.TEXT, None, "x" * 60)
    assert repr(event) == f"<text at 1.500 s of {'T' * 20}: {'x' * 57 + '...'!r}>"


@pytest.mark.parametrize("fraction", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("geometry", [Geometry.LINE, Geometry.JOINT])
def test_a_move_fails_at_its_fraction(geometry: Geometry, fraction: float) -> None:
    robot = load_robot("irb1600")
    joints = np.radians([0.0, -10.0, 20.0, 10.0, 60.0, 20.0])
    begin = Waypoint(joints, robot.forward(joints))
    end_pose = Transform(begin.base_from_tcp.rotation, begin.base_from_tcp.translation + 0.1)
    end = Waypoint(joints + 0.1, robot.forward(joints + 0.1))
    if geometry is Geometry.LINE:
        end = Waypoint(joints, end_pose)
    segment = plain_segment(geometry, begin, end, Transform.identity(), 0, Speed(0.5, 5.0), None)
    failed = failed_at_fraction(single(0), CutOff("x"), segment, fraction, robot)
    assert failed.curve[0] == pytest.approx(begin.base_from_tcp.translation, abs=1e-9)
    assert failed.curve[-1] == pytest.approx(end.base_from_tcp.translation, abs=1e-9)
    wanted = robot.forward(joints + 0.1 * fraction).translation
    if geometry is Geometry.LINE:
        wanted = begin.base_from_tcp.translation + 0.1 * fraction
    assert failed.fails_at == pytest.approx(wanted, abs=1e-4)
    refused = refused_axes(single(0), CutOff("x"), end.base_from_tcp)
    assert np.array_equal(refused.curve, end.base_from_tcp.translation[None])
