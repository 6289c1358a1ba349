"""What clients do to the program of a task: modules in and out, data by name, messages by type."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from live_controller import Live, module

from rapidsim.language.messages import MessageKind
from rapidsim.simulation.live import program_memory, symbols
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.messages import kind_of
from rapidsim.simulation.live.states import RefusalReason, RequestRefused

DATA = r"""RECORD part
  pose place;
  string name;
  num counts;
ENDRECORD
PERS num n := 3;
PERS num row{3} := [1,2,3];
PERS num grid{2,3} := [[1,2,3],[4,5,6]];
CONST string greeting := "hi";
LOCAL VAR bool flag := TRUE;
TASK PERS part p := [[[1,2,3],[1,0,0,0]],"a, b",4];
VAR intnum order;"""
BODY = "WaitTime 1000;"


def tried(home: Path | None = None) -> tuple[Live, LiveTask]:
    live = Live(module(BODY, DATA), home=home)
    return live, live.controller.task("T_ROB1")


def refused(ask: Callable[[], object]) -> tuple[RefusalReason, str]:
    with pytest.raises(RequestRefused) as caught:
        ask()
    return caught.value.why, str(caught.value)


@pytest.mark.parametrize(
    ("type_name", "text", "dimensions"),
    [
        ("num", "5", ()),
        ("NUM", "[1,2,3]", (3,)),
        ("num", "[[1,2,3], [4,5,6]]", (2, 3)),
        ("num", "[ [[1,2]],[[3,4]],[[5,6]],[[7,8]] ]", (4, 1, 2)),
        ("string", '"[1,2]"', ()),
        ("string", '["a,b","]","c"]', (3,)),
        ("pos", "[1,2,3]", ()),
        ("pos", "[[1,2,3],[4,5,6]]", (2,)),
        ("robtarget", "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]", ()),
        ("Part", '[[[1,2,3],[1,0,0,0]],"x",4]', ()),
        ("part", '[[[[1,2,3],[1,0,0,0]],"x",4],[[[1,2,3],[1,0,0,0]],"y",5]]', (2,)),
        ("nothing", "[1,2]", ()),
    ],
)
def test_the_kind_of_a_message_follows_from_its_text(
    type_name: str, text: str, dimensions: tuple[int, ...]
) -> None:
    _, task = tried()
    kind = kind_of(type_name, text, [task])
    assert kind.dimensions == dimensions
    assert kind.data_type.lower() == type_name.lower()
    if type_name == "nothing":
        assert kind == MessageKind("nothing")


def test_data_are_found_in_any_case_with_their_storage() -> None:
    _, task = tried()
    found = {one.name: one for one in symbols.all_data(task)}
    assert list(found) == ["n", "row", "grid", "greeting", "flag", "p", "order"]
    assert {name for name, one in found.items() if one.is_local} == {"flag"}
    assert {name for name, one in found.items() if one.is_task_only} == {"p"}
    assert {one.module for one in found.values()} == {"Tried"}
    assert [one.storage.value.upper() for one in found.values()] == [
        *("PERS", "PERS", "PERS", "CONST", "VAR", "PERS", "VAR")
    ]
    grid = symbols.find(task, "GRID", "tried")
    assert (grid.name, grid.dimensions, grid.type_name) == ("grid", (2, 3), "num")
    assert symbols.find(task, "n").dimensions == ()
    tool = symbols.find(task, "TOOL0")
    assert (tool.name, tool.module, tool.storage.value.upper()) == ("tool0", None, "PERS")
    assert symbols.find(task, "tool0", "BASE").name == "tool0"
    assert symbols.find(task, "pi").storage.value.upper() == "CONST"
    asked: list[tuple[str, str | None]] = [
        ("none", None),
        ("n", "Other"),
        ("pi", "BASE"),
        ("tool0", "Tried"),
    ]
    for name, place in asked:
        reason, message = refused(partial(symbols.find, task, name, place))
        assert (reason, message) == (RefusalReason.NO_SYMBOL, f"T_ROB1 has no data named {name}")


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("n", "3"),
        ("row{2}", "2"),
        ("grid", "[[1,2,3],[4,5,6]]"),
        ("grid{2,3}", "6"),
        ("p.place.trans", "[1,2,3]"),
        ("p.place.trans.y", "2"),
        ("P.Name", '"a, b"'),
        ("greeting", '"hi"'),
        ("tool0.mass", None),
        ("tool0.tload.mass", "0.001"),
        ("row{0}", None),
        ("row{4}", None),
        ("row{n}", None),
        ("row{1,1}", None),
        ("n.x", None),
    ],
)
def test_a_part_of_data_is_read_by_its_path(path: str, value: str | None) -> None:
    _, task = tried()
    if value is None:
        assert refused(lambda: symbols.find(task, path))[0] is RefusalReason.NO_SYMBOL
    else:
        assert symbols.read(task, symbols.find(task, path)) == value


def test_only_a_value_of_the_type_is_written_and_only_to_what_may_change() -> None:
    live, task = tried()

    def write(path: str, text: str) -> None:
        symbols.write(task, symbols.find(task, path), text)

    write("row{2}", "7")
    write("p.place.trans.y", "-2.5")
    write("flag", "FALSE")
    write("grid", "[[6,5,4],[3,2,1]]")
    read = {name: live.value(name) for name in ("row", "p", "flag", "grid")}
    assert read == {
        "row": "[1,7,3]",
        "p": '[[[1,-2.5,3],[1,0,0,0]],"a, b",4]',
        "flag": "FALSE",
        "grid": "[[6,5,4],[3,2,1]]",
    }
    for path, text, reason in (
        ("n", '"a"', RefusalReason.VALUE),
        ("row", "[1,2]", RefusalReason.VALUE),
        ("row{1}", "TRUE", RefusalReason.VALUE),
        ("greeting", '"ho"', RefusalReason.READ_ONLY),
        ("tool0", "1", RefusalReason.READ_ONLY),
        ("pi", "3", RefusalReason.READ_ONLY),
    ):
        assert refused(partial(write, path, text))[0] is reason
    assert symbols.is_value("[1,2,3]", "POS")
    assert not symbols.is_value("[1,2]", "pos")
    assert not symbols.is_value("1", "nothing")


PART = "MODULE Part\n  PERS num total := 5;\n  PROC help()\n  ENDPROC\nENDMODULE\n"


def names(task: LiveTask) -> list[str]:
    return [one.name.text for one in program_memory.modules(task)]


def test_a_module_is_loaded_replaced_and_unloaded(tmp_path: Path) -> None:
    (tmp_path / "part.mod").write_text(PART)
    (tmp_path / "other.mod").write_text(PART.replace("5", "6"))
    live, task = tried(tmp_path)
    program_memory.load_module(task, "HOME:/part.mod", replace=False)
    assert names(task) == ["Tried", "Part"]
    assert live.value("total") == "5"
    reason, _ = refused(lambda: program_memory.load_module(task, "HOME:/other.mod", replace=False))
    assert reason is RefusalReason.NO_FILE
    assert live.value("total") == "5"
    program_memory.load_module(task, "HOME:/other.mod", replace=True)
    assert live.value("total") == "6"
    live.write("total", "8")
    (part,) = (one for one in program_memory.modules(task) if one.name.text == "Part")
    assert program_memory.file_of(task, part) == PART.replace("5", "8").encode()
    program_memory.unload_module(task, "part")
    assert names(task) == ["Tried"]
    assert refused(lambda: program_memory.unload_module(task, "part"))[0] is RefusalReason.NO_MODULE
    missing = refused(lambda: program_memory.load_module(task, "HOME:/no.mod", replace=False))
    assert missing[0] is RefusalReason.NO_FILE


def test_a_program_replaces_all_but_system_modules(tmp_path: Path) -> None:
    folder = tmp_path / "cell"
    folder.mkdir()
    (folder / "cell.pgf").write_text(
        '<?xml version="1.0" encoding="ISO-8859-1" ?>\n<Program>\n'
        "\t<Module>a.mod</Module>\n\t<Module>b.mod</Module>\n</Program>\n"
    )
    (folder / "a.mod").write_text("MODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    (folder / "b.mod").write_text("MODULE b\n  PERS num k := 1;\nENDMODULE\n")
    (tmp_path / "lib.sys").write_text("MODULE lib(SYSMODULE)\nENDMODULE\n")
    (tmp_path / "wrong.mod").write_text("MODULE wrong\n  PROC main(\nENDMODULE\n")
    live, task = tried(tmp_path)
    program_memory.load_module(task, "HOME:/lib.sys", replace=False)
    reason, _ = refused(lambda: program_memory.load_program(task, "HOME:/wrong.mod"))
    assert reason is RefusalReason.NO_FILE
    assert names(task) == ["Tried", "lib"]
    program_memory.load_program(task, "HOME:/cell/cell.pgf")
    assert sorted(names(task)) == ["a", "b", "lib"]
    assert live.value("k") == "1"
    program_memory.load_program(task, "HOME:/cell/b.mod")
    assert sorted(names(task)) == ["b", "lib"]
    assert refused(lambda: program_memory.load_program(task, "HOME:/no.pgf"))[0] is (
        RefusalReason.NO_FILE
    )


def test_text_that_latin_1_lacks_is_utf_8() -> None:
    assert program_memory.encoded("prüfen") == b"pr\xfcfen"
    assert program_memory.encoded("Δ") == "Δ".encode()


def test_a_task_that_cannot_begin_has_no_modules_to_change() -> None:
    live = Live(module(BODY, "VAR num a := 1; VAR num b{2} := [1, 2]; VAR num c := 1 / 0;"))
    task = live.controller.task("T_ROB1")
    reason, message = refused(lambda: program_memory.unload_module(task, "Tried"))
    assert reason is RefusalReason.STATE
    assert message.startswith("the program of T_ROB1 cannot be made ready: ")
    assert refused(lambda: symbols.find(task, "a")) == (
        RefusalReason.NO_SYMBOL,
        "the data of T_ROB1 could not be initialised",
    )
    assert list(symbols.all_data(task)) == []
