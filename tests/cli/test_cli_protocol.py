"""Questions to a controller: written, answered here, read, compared and packed."""

import json
from pathlib import Path

from command_line import call

from rapidsim.jobs.protocol import ANSWERS, TOPICS, answered_here, questions


def test_a_run_answers_each_question_once(tmp_path: Path) -> None:
    for arm in ("irb1600", "irb120"):
        answered = answered_here(arm)
        assert tuple(answered.answers) == tuple(TOPICS)
        assert not [text for text in answered.answers.values() if not text]


def test_the_program_is_written_and_never_over_another(tmp_path: Path) -> None:
    assert call("protocol", cwd=tmp_path).code == 0
    assert (tmp_path / "Questions.mod").read_text() == questions()
    again = call("protocol", cwd=tmp_path)
    assert (again.code, again.err.splitlines()[0]) == (2, "error: Questions.mod is here already")
    rules = ("--robot", "irb1600", "--select", "E,N2,T")
    checked = call("check", "Questions.mod", *rules, cwd=tmp_path)
    assert "error" not in checked.out


def test_what_differs_is_marked_and_nothing_else_is_sent(tmp_path: Path) -> None:
    ours = answered_here("irb1600")
    lines = [f"{number};{text}" for number, text in ours.answers.items()]
    lines[0] = "1;3"
    header = ["questions;1", "robotware;6.15.02", "robot;IRB 1600-6/1.2", "serial;16-12345"]
    (tmp_path / ANSWERS).write_text("\n".join([*header, *lines]))
    shown = call("protocol", ANSWERS, "--robot", "irb1600", cwd=tmp_path, columns=120)
    differing = [line for line in shown.out.splitlines() if line.endswith("differs")]
    assert [line.split("  ")[0] for line in differing] == ["7.5 DIV 2"]
    packed = json.loads(call("protocol", ANSWERS, "--format", "json", cwd=tmp_path).out)
    assert packed.keys() == {"schema", "questions", "robotware", "robot", "answers"}
    assert packed["answers"]["1"] == "3"
    assert "16-12345" not in json.dumps(packed)


def test_another_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("1;3\n")
    ended = call("protocol", "notes.txt", cwd=tmp_path)
    assert ended.code == 2
    assert "does not hold answers to the questions" in ended.err
