"""Errors leave a trace in each output: events, JSON, text, page, recording, figures, Python."""

import json
from pathlib import Path

import pytest
from command_line import call
from live_controller import Live, module

import rapidsim
from rapidsim.api.run import Run
from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.language.error_numbers import ERR_OUTOFBND, ERR_WAIT_MAXTIME
from rapidsim.report.run.assertion_figures import asked_figures
from rapidsim.report.run.error_records import ErrorRecord, errors_text
from rapidsim.report.run.figures import figures

PROGRAM = r"""MODULE job
  VAR num n;
  VAR num list{3}:=[1,2,3];
  PROC main()
    FOR i FROM 1 TO 4 DO
      await i;
    ENDFOR
    pass;
    n:=list{n+9};
    TPWrite "never";
  ERROR
    IF ERRNO=5 TRYNEXT;
  ENDPROC
  PROC await(num turn)
    WaitUntil n>=3*turn\MaxTime:=0.5;
  ERROR
    n:=n+1;
    RETRY;
  ENDPROC
  PROC pass()
    RAISE 5;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
"""
ENDS = r"""MODULE job
  VAR num zero;
  PROC main()
    zero:=1/zero;
  ENDPROC
ENDMODULE
"""
TASKS = """
[robot]
model = "irb120"
[[task]]
name = "T_ROB1"
modules = ["one.mod"]
motion = true
[[task]]
name = "T_BACK"
modules = ["two.mod"]
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    file = tmp_path_factory.mktemp("job") / "job.mod"
    file.write_text(PROGRAM)
    return rapidsim.load(file, robot="irb120").run()


def test_each_kind_of_error_is_a_row(run: Run) -> None:
    def row(one: ErrorRecord) -> tuple[object, ...]:
        raised = (round(one.time_s, 2), one.number, one.name, one.routine, one.line)
        answered = (one.answered_by, one.answered_line, one.outcome, one.count)
        return (*raised, *answered, round(one.last_s, 2))

    assert list(map(row, run.errors)) == [
        (0.5, ERR_WAIT_MAXTIME, "ERR_WAIT_MAXTIME", "await", 15, "await", 16, "retried", 12, 6.0),
        (6.0, 5.0, "5", "pass", 21, "pass", 22, "raised", 1, 6.0),
        (6.0, 5.0, "5", "pass", 21, "main", 11, "next", 1, 6.0),
        (6.0, ERR_OUTOFBND, "ERR_OUTOFBND", "main", 9, "main", 11, "fell through", 1, 6.0),
    ]


def test_the_summary_names_them(run: Run) -> None:
    assert errors_text(run.simulation) == (
        "12 ERR_WAIT_MAXTIME at job.mod:15 retried, 1 error 5 at :21 skipped by main's clause, "
        "1 ERR_OUTOFBND at :9 fell through main's clause"
    )


def test_assertions_may_name_their_numbers(run: Run) -> None:
    """An error that a clause raises on is the same error."""
    simulation = run.simulation
    asked = asked_figures(simulation, figures(simulation), ())
    assert (asked["errors"], asked["errors_dropped"]) == (14.0, 1.0)


def test_each_kind_is_one_event(run: Run) -> None:
    events = [event for event in run.events if event.kind is EventKind.ERROR]
    assert [(event.details["outcome"], event.details["count"]) for event in events] == [
        ("retried", 12),
        ("raised", 1),
        ("next", 1),
        ("fell through", 1),
    ]
    assert [event.message for event in events][-1] == (
        "ERR_OUTOFBND: index 21 is outside the array, which has 1 to 3; fell through main's clause"
    )


def test_an_error_comes_before_what_its_clause_does(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(
        ENDS.replace("ENDPROC", 'ERROR TPWrite "noted"; TRYNEXT; ENDPROC')
    )
    run = rapidsim.load(tmp_path / "job.mod", robot="irb120").run()
    assert [event.kind.value for event in run.events] == ["error", "text"]


def test_main_whose_clause_ends_it_ended_early(run: Run) -> None:
    assert run.as_json()["qualifications"] == [
        "ended early: ERR_OUTOFBND at job.mod:9 fell through main's clause"
    ]
    assert run.ok


def test_an_error_without_a_clause_ended_the_program(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(ENDS)
    ended = call("run", "job.mod", "--no-record", "--format", "json", cwd=tmp_path)
    report = json.loads(ended.out)
    (error,) = report["errors"]
    assert (error["name"], error["line"], error["answered_by"], error["outcome"]) == (
        "ERR_DIVZERO",
        4,
        None,
        "ended the program",
    )
    assert ended.code == 1


def test_text_page_and_recording_show_them(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    outputs = ("--report", "job.html", "--record", "job.rrd", "--events", "job.jsonl")
    ended = call("run", "job.mod", "--robot", "irb120", *outputs, cwd=tmp_path)
    assert "ended early: ERR_OUTOFBND" in " ".join(ended.out.split())
    page = (tmp_path / "job.html").read_text(encoding="utf-8")
    assert "<h2>Errors<small>14 raised, 1 fell through</small></h2>" in page
    lines = (tmp_path / "job.jsonl").read_text(encoding="utf-8").splitlines()
    kinds = [one["outcome"] for one in map(json.loads, lines) if one["kind"] == "error"]
    assert kinds == ["retried", "raised", "next", "fell through"]


def test_errors_of_other_tasks_say_whose_they_are(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(TASKS)
    (tmp_path / "one.mod").write_text(ENDS.replace("ENDPROC", "ERROR TRYNEXT; ENDPROC"))
    (tmp_path / "two.mod").write_text(
        ENDS.replace("MODULE job", "MODULE two")
        .replace("zero:=1/zero;", "WaitTime 1; zero:=1/zero;")
        .replace("ENDPROC", "ERROR RETURN; ENDPROC")
    )
    run = rapidsim.load(tmp_path).run()
    assert [(one.task, one.outcome) for one in run.errors] == [
        ("T_ROB1", "next"),
        ("T_BACK", "returned"),
    ]


def test_a_loop_that_fails_for_ever_is_one_event(tmp_path: Path) -> None:
    body = "WHILE TRUE DO zero:=1/zero; ENDWHILE\n  ERROR TRYNEXT;"
    (tmp_path / "job.mod").write_text(ENDS.replace("zero:=1/zero;", body))
    run = rapidsim.load(tmp_path / "job.mod", robot="irb120").run(max_time_s=0.2)
    (error,) = run.errors
    assert (error.outcome, len(run.events)) == ("next", 1)
    assert error.count == 200


def test_a_served_controller_logs_only_what_stops_a_program() -> None:
    """A controller keeps no entry of an error that a clause has handled."""
    live = Live(
        module("once; n := 1/n;", "VAR num n;", "PROC once() n := 1/n; ERROR TRYNEXT; ENDPROC")
    )
    live.controller.start()
    live.after(1.0)
    logged = [entry.text for entry in live.entries if entry.type == 3]
    assert len(logged) == 2
    assert all("division by zero" in text for text in logged)


def test_the_errors_of_a_served_program_are_events_each_time_they_are_read() -> None:
    live = Live(
        module("n := 1/n; WaitTime 1;", "VAR num n;", "").replace(
            "ENDPROC", "ERROR TRYNEXT; ENDPROC"
        )
    )
    seen: list[Event] = []
    live.controller.happened = seen.append
    live.controller.start()
    live.after(2.5)
    assert [event.details["count"] for event in seen if event.kind is EventKind.ERROR] == [1, 1, 1]
