"""Module data: initial values, constants, persistents, what stays from run to run."""

from __future__ import annotations

import pytest
from interpreter_cell import loaded, main, module, texts

from rapidsim.interpreter.linking.loader import FatalError
from rapidsim.language.data import Pos


def test_variables_begin_as_zero() -> None:
    data = "VAR num n; VAR bool b; VAR string s; VAR pose f; VAR num a{2,2};"
    task, _ = loaded(main("", data))
    assert task.value("n") == 0.0
    assert task.value("B") is False
    assert task.value("s") == ""
    assert task.value("f") == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
    assert task.value("a") == [[0.0, 0.0], [0.0, 0.0]]


def test_constants_may_stand_in_any_order() -> None:
    data = """
      CONST num c := b * 2;
      CONST num b := a + 1;
      CONST num a := 2;
      CONST pos p := [c, b, a];
      CONST num list{3} := [a, b, c];
      VAR num x := c + 1;
      VAR num twice{3} := [c, c, c];
    """
    task, _ = loaded(main("", data))
    assert task.value("c") == 6.0
    assert task.value("p") == Pos(6.0, 3.0, 2.0)
    assert task.value("list") == [2.0, 3.0, 6.0]
    assert task.value("x") == 7.0
    assert task.value("twice") == [6.0, 6.0, 6.0]


def test_constants_are_rounded_like_any_num() -> None:
    data = "CONST num third := 1 / 3; VAR num x;"
    assert texts(main("x := 1 / 3; TPWrite ValToStr(x = third);", data)) == ["TRUE"]


def test_routines_have_constants_too() -> None:
    more = """
      PROC p(num v)
        CONST num size := 2;
        CONST pos at := [1, size, 3];
        VAR num list{size};
        FOR at FROM 1 TO 1 DO list{1} := at; ENDFOR
        TPWrite ValToStr(at.y + list{1} + Dim(list, 1) + v);
      ENDPROC
    """
    assert texts(main("p 1;", "", more)) == ["6"]


def test_a_failing_initial_value_says_where() -> None:
    data = "CONST num zero := 0;\nVAR num x := 1 / zero;"
    with pytest.raises(FatalError) as caught:
        loaded(main("", data))
    assert caught.value.stack[0].line == 3


def test_persistents_report_what_changed() -> None:
    data = """
      PERS num count := 1;
      PERS num same := 2;
      LOCAL PERS num list{3} := [1, 2, 3];
      PERS wobjdata w := [FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    """
    task, _ = loaded(main("count := count + 1; list{2} := 5; w.oframe.trans.x := 7;", data))
    assert task.persistents() == ()
    task.run()
    changes = {
        change.name: (change.module, change.old, change.new) for change in task.persistents()
    }
    assert changes["count"] == ("cell", 1.0, 2.0)
    assert changes["list"] == ("cell", [1.0, 2.0, 3.0], [1.0, 5.0, 3.0])
    assert changes["w"][2].oframe.trans == Pos(7.0, 0.0, 0.0)
    assert "same" not in changes


def test_variables_keep_their_values_between_runs() -> None:
    task, controller = loaded(main("n := n + 1; TPWrite ValToStr(n);", "VAR num n;"))
    task.run()
    task.run("MAIN")
    assert controller.texts == ["1", "2"]


def test_two_tasks_share_no_variables() -> None:
    text = main("n := n + 1; a{1} := n;", "VAR num n; VAR num a{2}; PERS num p := 1;")
    first, _ = loaded(text)
    second, _ = loaded(text)
    first.run()
    assert (first.value("n"), second.value("n"), second.value("a")) == (1.0, 0.0, [0.0, 0.0])


def test_predefined_data() -> None:
    task, _ = loaded(main("reg1 := reg1 + pi; TPWrite ValToStr(reg1) + ValToStr(v100.v_tcp);"))
    task.run()
    assert task.value("reg1") == pytest.approx(3.1415926)
    assert task.value("tool0").robhold is True
    assert task.value("reg5") == 0.0


def test_local_data_are_found_by_module() -> None:
    first = main("", "LOCAL VAR num n := 1;")
    second = "MODULE two\nLOCAL VAR num n := 2;\nENDMODULE\n"
    task, _ = loaded(first, second)
    assert (task.value("n", "cell"), task.value("n", "TWO")) == (1.0, 2.0)
    with pytest.raises(LookupError):
        task.value("m")


def test_an_entry_must_be_there() -> None:
    task, _ = loaded(module("PROC start() ENDPROC PROC other(num n) ENDPROC"))
    task.run("start")
    for entry in ("main", "other"):
        with pytest.raises(LookupError):
            task.run(entry)


def test_loading_runs_nothing() -> None:
    _, controller = loaded(main('TPWrite "no";'))
    assert controller.texts == []
