"""Runs that are left out of a tree: their columns and rows are what the parser reads."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
import pytest
from calls_between import with_calls
from exports import export

from rapidsim.diagnostics import Source
from rapidsim.jobs.checking.bulk_representatives import bulk_reading
from rapidsim.language.single_precision import single
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_rows import statement_of
from rapidsim.syntax.parser import parse


def _facts(part: Any) -> Any:
    """A part of a tree, comparable."""
    if isinstance(part, tuple):
        return tuple(map(_facts, part))
    if is_dataclass(part):
        return type(part), [_facts(getattr(part, one.name)) for one in fields(part)]
    return part


def _singles(value: Any) -> list[float]:
    """The numbers of a literal as a run would have them."""
    return [single(one) for part in value for one in part]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", ""),
        ("\n", "\r\n"),
        (",", " , "),
        ("tool0", "tool0\\TLoad:=load0"),
        ("v200", "[200,  500,5000,1000]"),
        ("    MoveL", "MOVEL\t"),
        ("0.000000,0", "1E-7,+.0"),
    ],
)
def test_rows_are_the_statements_that_the_parser_reads(old: str, new: str) -> None:
    text = with_calls(["SetDO do1,1;", "Set do2;\nSetAO ao,reg1;"], 130, 7, "tilted")
    text = text.replace(old, new) if old else text
    source = Source("export.mod", text)
    (whole,), (left_out,) = (parse(source, few).file.modules for few in (None, bulk_reading(40)))
    assert not whole.runs
    assert sum(len(run) for run in left_out.runs) == 98
    by_place = {one.start: one for one in whole.routines[0].body}
    kept = {one.start for one in left_out.routines[0].body}
    for run in left_out.runs:
        assert isinstance(run.like, tree.Call)
        for row, numbers in zip(run.rows(), run.numbers, strict=True):
            statement = by_place.pop(row.start)
            assert _facts(statement_of(row, text)) == _facts(statement)
            assert row.end == statement.end
            assert isinstance(statement, tree.Call)
            argument = statement.arguments[0]
            assert isinstance(argument, tree.RequiredArgument)
            assert isinstance(argument.value, tree.LiteralAggregate)
            assert np.array_equal(numbers.astype(np.float64), _singles(argument.value.value))
        assert run.between
        for call in run.between:
            _assert_repeats(call, run, whole.routines[0].body, text)
            assert call.like.start in kept
            assert call.move.start in kept
            for row in call.rows():
                by_place.pop(row.start)
    assert by_place.keys() == kept


def _assert_repeats(
    call: tree.RepeatedCall, run: tree.BulkStatements, body: tree.Body, text: str
) -> None:
    """The statements at its places are the call, each behind as many moves as it says."""
    places = [one.start for one in body]
    for row, before in zip(call.rows(), call.moves_before.tolist(), strict=True):
        statement = body[places.index(row.start)]
        assert (row.start, row.end) == (statement.start, statement.end)
        assert text[row.start : row.end] == text[call.like.start : call.like.end]
        assert np.count_nonzero(run.starts < row.start) == before


def test_a_text_with_few_of_them_has_no_runs() -> None:
    source = Source("export.mod", export("inline", "raster", 40))
    assert not parse(source, bulk_reading(40)).file.modules[0].runs
    assert parse(source, bulk_reading(30)).file.modules[0].runs
