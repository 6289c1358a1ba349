"""Records are written, described and read back by one declaration."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Annotated, Any, ClassVar

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from laws import examples

from rapidsim.json_records.declarations import Key, Lenient, OrAbsent, Rounded, ValueForm
from rapidsim.json_records.encoding import json_of
from rapidsim.json_records.reading import WrongValueError, read, read_partially
from rapidsim.json_records.schema import SchemaWriter
from rapidsim.values import value_class


class Colour(Enum):
    RED = "red"
    BLUE = "blue"


@value_class(frozen=True, slots=True)
class Place:
    file: str | None
    line: int


@value_class(frozen=True, slots=True)
class Row:
    """One row."""

    schema: ClassVar[int] = 7
    """Version."""
    awaited: Annotated[str, Key("for")]
    """Condition, with a key
    of its own."""
    time_s: Rounded
    exact: float | None
    colour: Colour
    absent: OrAbsent[int]
    place: Annotated[Place, ValueForm.INLINE]
    rows: tuple[Row, ...]
    values: Mapping[str, Rounded]
    matrix: Sequence[Sequence[float]]
    other: bool | float | str = True
    names: Lenient[tuple[str, ...]] = ()


LEAF = Row("x", 1.0, None, Colour.RED, None, Place(None, 3), (), {}, ())
ROWS = st.recursive(
    st.just(LEAF),
    lambda rows: st.builds(
        Row,
        awaited=st.text(),
        time_s=st.integers(-1000, 1000).map(lambda n: n / 8.0),
        exact=st.none() | st.floats(allow_nan=False, allow_infinity=False),
        colour=st.sampled_from(Colour),
        absent=st.none() | st.integers(),
        place=st.builds(Place, st.none() | st.text(), st.integers()),
        rows=st.lists(rows, max_size=3).map(tuple),
        values=st.dictionaries(st.text(), st.integers(0, 99).map(float), max_size=3),
        matrix=st.just(((1.0, 2.0), (3.0, 4.0))),
        other=st.booleans() | st.text(),
        names=st.lists(st.text(), max_size=2).map(tuple),
    ),
    max_leaves=6,
)


def schema() -> dict[str, Any]:
    writer = SchemaWriter()
    return {**writer.object_of(Row), "$defs": writer.definitions}


@examples(100)
@given(ROWS)
def test_what_is_written_is_valid_and_read_back(row: Row) -> None:
    written = json.loads(json.dumps(json_of(row), allow_nan=False))
    Draft202012Validator(schema()).validate(written)
    assert read(Row, written) == row


def test_keys_are_in_the_order_of_the_declaration() -> None:
    keys = ["schema", "for", "time_s", "exact", "colour", "file", "line", "rows", "values"]
    assert list(json_of(LEAF)) == [*keys, "matrix", "other", "names"]


def test_only_numbers_of_runs_are_rounded() -> None:
    third = 1.0 / 3.0
    row = Row("", third, third, Colour.RED, 0, Place("", 0), (), {"a": math.inf}, ((third,),))
    written = json_of(row)
    assert (written["time_s"], written["exact"]) == (0.33333333, third)
    assert (written["absent"], written["values"], written["matrix"]) == (0, {"a": None}, [[third]])


def test_a_schema_has_descriptions_and_definitions() -> None:
    made = schema()
    assert made["properties"]["for"] == {
        "type": "string",
        "description": "Condition, with a key of its own.",
    }
    assert made["properties"]["rows"] == {"type": "array", "items": {"$ref": "#/$defs/Row"}}
    assert made["properties"]["exact"]["type"] == ["number", "null"]
    assert made["properties"]["colour"] == {"type": "string", "enum": ["red", "blue"]}
    assert "absent" not in made["required"]
    assert {"schema", "file", "line", "names"} <= set(made["required"])


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("for", 3, "for is not text"),
        ("time_s", "1", "time_s is not a number"),
        ("time_s", None, "time_s is not a number"),
        ("time_s", 10**400, "time_s is not a finite number"),
        ("line", True, "line is not a whole number"),
        ("line", 1.0, "line is not a whole number"),
        ("colour", [], "colour is `[]`, and not one of red, blue"),
        ("rows", {}, "rows is not a list"),
        ("rows", [0], "rows[0] is not an object"),
        ("values", [], "values is not an object"),
        ("matrix", [[1.0], ["x"]], "matrix[1][0] is not a number"),
    ],
)
def test_a_wrong_value_is_named(key: str, value: object, message: str) -> None:
    with pytest.raises(WrongValueError, match="^" + message.replace("[", r"\[") + "$"):
        read(Row, {**json_of(LEAF), key: value})


def test_a_missing_key_is_named() -> None:
    written = json_of(LEAF)
    del written["colour"]
    with pytest.raises(WrongValueError, match=r"^colour is missing$"):
        read(Row, written)
    assert read(Row, {**json_of(LEAF), "newer": 1}) == LEAF


def test_a_record_of_another_version_is_read_where_it_is_used() -> None:
    old = read_partially(Row, {"for": "x", "rows": [{"time_s": 1, "line": "a"}], "colour": 0})
    assert (old.awaited, old.names, old.exact, old.absent) == ("x", (), None, None)
    assert [one.time_s for one in old.rows] == [1.0]
    with pytest.raises(WrongValueError, match=r"^rows\[0\]\.line is not a whole number$"):
        _ = old.rows[0].place.line
    with pytest.raises(WrongValueError, match=r"^time_s is missing$"):
        _ = old.time_s
    with pytest.raises(WrongValueError, match=r"^it is not an object$"):
        read_partially(Row, [])
