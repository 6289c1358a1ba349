"""The Python API: a cell is loaded, checked, run and called, and everything can be pickled."""

import json
import pickle
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from command_line import call

import rapidsim
from rapidsim.api.run import Run
from rapidsim.api.views import Edge

PROGRAMS = Path(__file__).parent / "programs"
ROOT = Path(__file__).parents[2]
CELL = ROOT / "programs" / "cell"
LONGEST = 120


@pytest.fixture(scope="module")
def run() -> Run:
    return rapidsim.load(PROGRAMS / "waits.mod").run(answers=["5"])


@pytest.fixture(scope="module")
def geometry() -> rapidsim.Cell:
    return rapidsim.load(PROGRAMS / "geometry.mod")


def test_a_run_is_what_the_command_says(run: Run, tmp_path: Path) -> None:
    answers = tmp_path / "answers.txt"
    answers.write_text("5\n")
    program = PROGRAMS / "waits.mod"
    printed = call(
        "run", program, "--no-record", "--answers", answers, "--format", "json", cwd=tmp_path
    )
    assert json.loads(json.dumps(run.as_json())) == json.loads(printed.out)
    assert (run.end, run.ok, run.error) == ("ended", True, None)
    assert run.time_s == pytest.approx(run.motion_s + run.wait_s)
    assert [move.instruction for move in run.moves] == ["MoveAbsJ", "MoveAbsJ"]
    columns = run.moves.columns
    assert columns.joints_deg == pytest.approx(np.array([move.joints_deg for move in run.moves]))
    ends = np.array([move.target.position_mm for move in run.moves])
    assert columns.position_mm == pytest.approx(ends)
    for name in ("index", "line", "start_s", "end_s", "length_mm", "speed_mm_s", "zone_mm"):
        assert getattr(columns, name).tolist() == [getattr(move, name) for move in run.moves]
    assert run.moves[0].joints_deg[4] == pytest.approx(40.0)


def test_the_second_grip_fails() -> None:
    gripped = {"when": "doGrip = 1", "after": 0.35, "set": {"diGripped": 1, "diPart": 0}}
    cell = rapidsim.load(CELL)
    as_ever = cell.run(io={"stimulus": [gripped]})
    assert as_ever.time_s == cell.run().time_s
    failed = cell.run(io={"stimulus": [{**gripped, "skip": (2,)}]})
    assert failed.error is not None
    assert (failed.end, failed.error.code, failed.error.line) == ("error", "R106", 31)
    edges = failed.signals["diGripped"].edges
    assert sum(edge.new == 1.0 for edge in edges) == 1
    assert edges == as_ever.signals["diGripped"].edges[: len(edges)]


def test_tables_from_python_and_a_file_are_the_same(tmp_path: Path) -> None:
    file = tmp_path / "io.toml"
    file.write_text('[signals]\ndiSpare = { type = "di", value = 1 }\n')
    tables = {"signals": {"diSpare": {"type": "di", "value": 1}}}
    cell = rapidsim.load(PROGRAMS / "waits.mod")
    by_file, by_tables = (cell.run(answers=["5"], io=one) for one in (file, tables))
    assert by_file.as_json() == by_tables.as_json()
    with pytest.raises(rapidsim.InputError, match="io: signal: no such key"):
        cell.run(io={"signal": {}})


def test_waits_say_for_what_and_by_whom_they_ended(run: Run) -> None:
    told = [(wait.line, wait.instruction, wait.awaited, wait.ended_by) for wait in run.waits]
    assert told == [
        (6, "WaitTime", "0.5 s", "the time"),
        (8, "WaitDI", "diGripped = 1", "diGripped = 1, set by the station"),
        (9, "WaitUntil", "diGripped=0", "diGripped = 0, set by the station"),
        (13, "WaitDI", "diNever = 1", "its time limit"),
    ]
    waited_s = sum(wait.end_s - wait.start_s for wait in run.waits)
    assert waited_s == pytest.approx(run.wait_s, abs=1e-3)


def test_data_are_there_by_name_changed_or_not(run: Run, geometry: rapidsim.Cell) -> None:
    assert run.data["nparts"] == 5.0
    assert run.data["waits/NPARTS"] == run.data["T_ROB1/waits/nParts"] == 5.0
    with pytest.raises(KeyError, match="did you mean `nParts`"):
        run.data["nPart"]
    left = geometry.run().data
    assert sorted(left) == ["big", "nCalls", "p"]
    assert tuple(left["big"]) == (3.0, 4.0)
    assert left["p"].trans.x == 600.0


def test_signals_have_a_value_at_any_time(run: Run) -> None:
    gripped = run.signals["DIGRIPPED"]
    (rise, fall) = gripped.edges
    assert rise == Edge(run.waits[1].end_s, 0.0, 1.0)
    assert fall == (2.0, 1.0, 0.0)
    assert [gripped.at(t) for t in (0.0, rise.time_s, 1.9, 2.0, 99.0)] == [0.0, 1.0, 1.0, 0.0, 0.0]
    assert (gripped.rises_s, gripped.falls_s) == ((rise.time_s,), (2.0,))
    assert run.signals["diNever"].edges == ()


def test_the_arm_is_somewhere_at_any_time(run: Run) -> None:
    end = run.moves[0].end_s
    once, often = run.trajectory.at(end), run.trajectory.at([0.0, end])
    assert once.joints_deg == pytest.approx(run.moves[0].joints_deg, abs=1e-6)
    assert np.array_equal(often.joints_deg[1], once.joints_deg)
    assert once.position_mm == pytest.approx(run.moves[0].target.position_mm, abs=1e-6)
    assert (once.move, np.ravel(often.move).tolist()) == (0, [0, 0])


def test_files_are_written(run: Run, tmp_path: Path) -> None:
    assert run.record(tmp_path / "x.rrd").stat().st_size > 1000
    assert "waits.mod" in run.report(tmp_path / "x.html").read_text(encoding="utf-8")
    assert run.trace(tmp_path / "x.csv").read_text().startswith("time_s,")
    assert run.write_events(tmp_path / "x.jsonl").read_text()


@pytest.mark.parametrize(
    ("routine", "arguments", "optional", "value"),
    [
        ("area", (2, 3), {}, 6.0),
        ("AREA", (np.float64(0.1), 10), {}, 1.0),
        ("total", ([1, 2, 3.5],), {}, 6.5),
        ("middle", ([0, 0, 0], (2, 4, 6)), {}, (1.0, 2.0, 3.0)),
        ("grow", (4,), {}, 5.0),
        ("grow", (4,), {"By": 2, "twice": True}, 14.0),
        ("grow", (4,), {"twice": False}, 5.0),
        ("set", ("doGrip",), {}, None),
        ("main", (), {}, None),
    ],
)
def test_any_routine_can_be_called(
    routine: str,
    arguments: tuple[object, ...],
    optional: dict[str, object],
    value: object,
    geometry: rapidsim.Cell,
) -> None:
    assert geometry.call(routine, *arguments, **optional) == value  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("routine", "arguments", "words"),
    [
        ("aria", (1, 2), "no routine `aria`"),
        ("area", (1,), r"takes 2 required arguments \(num a, num b\), and 1 were given"),
        ("area", (1, "x"), "argument `b`: 'x' is no num"),
        ("area", (True, 1), "argument `a`: True is no num"),
        ("area", (float("inf"), 1), "argument `a`: inf is no num"),
        ("middle", ([1, 2], [1, 2, 3]), r"argument `a`: \[1, 2\] is no pos"),
        ("set", (1,), "the name of a signal is needed"),
    ],
)
def test_what_does_not_fit_is_refused(
    routine: str, arguments: tuple[object, ...], words: str, geometry: rapidsim.Cell
) -> None:
    with pytest.raises(rapidsim.InputError, match=words):
        geometry.call(routine, *arguments)


def test_an_optional_argument_that_is_none_is_refused(geometry: rapidsim.Cell) -> None:
    with pytest.raises(rapidsim.InputError, match="no optional argument `bye`"):
        geometry.call("grow", 1, bye=2)


def test_an_error_in_a_routine_has_its_place(geometry: rapidsim.Cell) -> None:
    with pytest.raises(rapidsim.CallError, match="division by zero") as raised:
        geometry.call("fails")
    found = raised.value.diagnostics[-1]
    assert (found.code, found.severity, found.line) == ("R101", "error", 20)
    assert found.file == str(PROGRAMS / "geometry.mod")


def test_check_finds_what_the_command_finds(tmp_path: Path) -> None:
    program = ROOT / "programs" / "out_of_reach.mod"
    found = rapidsim.load(program).check()
    printed = json.loads(
        call("check", program, "--output-format", "json", "--no-merge", cwd=tmp_path).out
    )
    fields = ("code", "severity", "message", "file", "line", "column", "help")
    told = [tuple(getattr(one, field) for field in fields) for one in found.diagnostics]
    assert told == [tuple(one[field] for field in fields) for one in printed["diagnostics"]]
    only = rapidsim.load(program).check(select=["K6"], run=False)
    assert {one.code[:2] for one in only.diagnostics} == {"K6"}


def test_a_run_that_fails_is_a_result(tmp_path: Path) -> None:
    program = tmp_path / "fails.mod"
    program.write_text("MODULE m\nPROC main()\nVAR num n;\nn:=1/n;\nENDPROC\nENDMODULE\n")
    run = rapidsim.load(program).run(home=tmp_path)
    assert (run.end, run.ok) == ("error", False)
    assert run.error is not None
    assert (run.error.line, run.error.message) == (4, "division by zero (ERR_DIVZERO)")


def test_a_program_with_errors_is_refused(tmp_path: Path) -> None:
    program = tmp_path / "wrong.mod"
    program.write_text("MODULE m\nPROC main()\nn:=1;\nENDPROC\nENDMODULE\n")
    cell = rapidsim.load(program)
    for asked in (cell.run, partial(cell.call, "main")):
        with pytest.raises(rapidsim.ProgramRejectedError) as raised:
            asked()
        again = pickle.loads(pickle.dumps(raised.value))
        assert (str(again), len(again.diagnostics)) == (str(raised.value), 1)


def test_several_robots_are_asked_by_task() -> None:
    run = rapidsim.load(ROOT / "programs" / "multimove").run()
    with pytest.raises(rapidsim.InputError, match="2 robots"):
        _ = run.trajectory
    second = run.trajectory_of("t_right")
    its_moves = [move for move in run.moves if move.task == "T_RIGHT"]
    end = second.at(run.time_s)
    assert end.joints_deg == pytest.approx(its_moves[-1].joints_deg, abs=1e-6)
    assert (second.at(0.0).move, end.move) == (its_moves[0].index, its_moves[-1].index)


def test_all_of_it_can_be_pickled(run: Run, geometry: rapidsim.Cell) -> None:
    again = pickle.loads(pickle.dumps(run))
    assert again.as_json() == run.as_json()
    assert dict(again.data) == dict(run.data)
    assert again.trajectory.at(1.0).joints_deg == pytest.approx(run.trajectory.at(1.0).joints_deg)
    assert pickle.loads(pickle.dumps(geometry)).call("area", 2, 3) == 6.0
    left = pickle.loads(pickle.dumps(geometry.run()))
    assert left.data["big"].w == 3.0
    checked = rapidsim.load(ROOT / "programs" / "out_of_reach.mod").check()
    found = pickle.loads(pickle.dumps(checked)).diagnostics
    assert [str(one.message) for one in found] == [one.message for one in checked.diagnostics]
    with pytest.raises(rapidsim.CallError) as raised:
        geometry.call("fails")
    assert str(pickle.loads(pickle.dumps(raised.value))) == "division by zero (ERR_DIVZERO)"


def test_nothing_is_shown_in_more_than_a_line(run: Run, geometry: rapidsim.Cell) -> None:
    checked = rapidsim.load(ROOT / "programs" / "out_of_reach.mod").check()
    cell_run = rapidsim.load(CELL).run()
    shown = [
        *(run, geometry, checked, checked.coverage, run.simulation, run.trajectory, run.signals),
        *(run.trajectory.at(1.0), run.trajectory.at([1.0, 2.0]), run.signals["doGrip"], run.data),
        *(*run.moves, *run.waits, *run.events, *run.simulation.robots, *run.simulation.moves),
        *(*checked.diagnostics, *checked.trees, *cell_run.diagnostics, *cell_run.events),
        *(one.value for one in cell_run.all_data),
        rapidsim.parse(checked.trees[0].source),
        rapidsim.load_robot("irb120"),
    ]
    too_long = [text for text in map(repr, shown) if len(text) > LONGEST or "\n" in text]
    assert not too_long


def test_texts_replace_those_on_the_disk(tmp_path: Path) -> None:
    file = tmp_path / "m.mod"
    file.write_text("MODULE m\n  PROC main()\n    b;\n  ENDPROC\nENDMODULE\n", encoding="utf-8")
    unsaved = file.read_text(encoding="utf-8").replace("    b;\n", "")
    assert [one.code for one in rapidsim.load(file).check().diagnostics] == ["N209"]
    cell = rapidsim.load(file, texts={file: unsaved})
    assert not cell.check().diagnostics
    assert cell.run().end == "ended"
    with pytest.raises(rapidsim.InputError, match="no file of the program"):
        rapidsim.load(file, texts={tmp_path / "other.mod": ""})
