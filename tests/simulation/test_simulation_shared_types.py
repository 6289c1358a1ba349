"""A PERS of a user's type that two tasks declare is one datum, whatever the type is made of."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from simulation_tasks import ran

PLAIN = {"num": ("0", "7"), "bool": ("FALSE", "TRUE"), "string": ('""', '"x"'), "pos": None}


@dataclass(frozen=True)
class Shape:
    """A type, the declarations it needs, and two values of it."""

    name: str
    declarations: tuple[str, ...]
    old: str
    new: str


@st.composite
def shapes(draw: st.DrawFn, depth: int = 2) -> Shape:
    """Plain types, aliases, and records of them and of records."""
    kind = draw(st.sampled_from(["plain", "alias", "record"])) if depth else "plain"
    if kind == "plain":
        name = draw(st.sampled_from(["num", "bool", "string", "pos"]))
        old, new = PLAIN[name] or ("[0,0,0]", "[1,2,3]")
        return Shape(name, (), old, new)
    number = draw(st.integers(0, 10**6))
    if kind == "alias":
        of = draw(shapes(depth=0))
        return Shape(f"alias{number}", (f"ALIAS {of.name} alias{number};",), of.old, of.new)
    parts = draw(st.lists(shapes(depth=depth - 1), min_size=1, max_size=3))
    fields = "\n".join(f"{part.name} part{n};" for n, part in enumerate(parts))
    above = dict.fromkeys(line for part in parts for line in part.declarations)
    record = f"RECORD record{number}\n{fields}\nENDRECORD"
    return Shape(
        f"record{number}",
        (*above, record),
        f"[{','.join(part.old for part in parts)}]",
        f"[{','.join(part.new for part in parts)}]",
    )


@given(shape=shapes(), size=st.sampled_from([0, 1, 3]))
@examples(12)
def test_tasks_share_a_persistent_of_any_type(shape: Shape, size: int) -> None:
    dimension, old, new = "", shape.old, shape.new
    if size:
        dimension = f"{{{size}}}"
        old, new = (f"[{','.join([one] * size)}]" for one in (old, new))
    element = "{1}" if size else ""
    data = "\n".join((*shape.declarations, f"PERS {shape.name} shared{dimension}:={old};"))
    target = f"CONST {shape.name} wanted:={shape.new};"
    it = ran(
        {
            "T_ROB1": f"{data}\n{target}\nPROC main()\nWaitTime 1;\n"
            f"shared{element}:=wanted;\nENDPROC",
            "T_ROB2": f"{data}\n{target}\nPROC main()\nWaitUntil shared{element}=wanted;\n"
            'TPWrite "seen";\nENDPROC',
        },
        max_time_s=5.0,
    )
    assert [text for _, text in it.texts] == ["seen"]
    (change,) = {one.name for one in it.run.persistents}
    assert change == "shared"
