"""Questions to a controller: written, answered here, read, compared and packed."""

import json
import re
from pathlib import Path

import pytest
from command_line import call

from rapidsim.applications.protocol.protocol import (
    ANSWERS,
    MODULE,
    TOPICS,
    Protocol,
    arm_of,
    questions,
    read_protocol,
    run_protocol,
)


def written(folder: Path, changed: dict[str, str], robot: str = "IRB 1600-6/1.2") -> None:
    """Answers of a controller that are those of rapidsim but for some lines."""
    ours = run_protocol("irb1600")
    lines = {"questions": "2", "robotware": "6.15.02", "robot": robot, "serial": "16-12345"}
    lines |= {"real": "TRUE", "automatic": "TRUE", "speed": "100"}
    lines |= {str(number): text for number, text in ours.answers.items()} | changed
    (folder / ANSWERS).write_text("".join(f"{key};{text}\n" for key, text in lines.items()))


def differing(folder: Path, *arguments: str) -> dict[str, str]:
    """The remarks of the comparison, by the first words of the question."""
    shown = call("protocol", ANSWERS, *arguments, cwd=folder, columns=200)
    rows = [re.split(r" {2,}", line.strip()) for line in shown.out.splitlines()[1:]]
    return {row[0][:20].strip(): row[3] for row in rows if len(row) == 4}


def test_a_run_answers_each_question(tmp_path: Path) -> None:
    for arm in ("irb1600", "irb120"):
        answered = run_protocol(arm)
        assert tuple(answered.answers) == tuple(TOPICS)
        assert not [text for text in answered.answers.values() if not text]
        assert "the program stops" not in answered.answers.values()


def test_a_question_that_stops_the_program_is_left_behind(tmp_path: Path) -> None:
    # A controller may well stop at the first question: the next start goes on with the second.
    program = questions().replace("n:=n DIV 2;", "Stop;\n    EXIT;")
    assert program != questions()
    (tmp_path / MODULE).write_text(program)
    run = ("run", MODULE, "--robot", "irb1600", "--no-record", "--write-pers", "--home", ".")
    first = call(*run, cwd=tmp_path)
    assert read_protocol(tmp_path / ANSWERS).answers == {1: "the program stops"}, first.out
    call(*run, cwd=tmp_path)
    answers = read_protocol(tmp_path / ANSWERS).answers
    assert tuple(answers) == tuple(TOPICS)
    assert [number for number, text in answers.items() if text == "the program stops"] == [1]


def test_moves_can_be_left_out(tmp_path: Path) -> None:
    without = questions().replace("with_moves:=TRUE", "with_moves:=FALSE")
    (tmp_path / MODULE).write_text(without)
    ran = call("run", MODULE, "--no-record", "--home", ".", "--format", "json", cwd=tmp_path)
    assert json.loads(ran.out)["moves"] == []
    assert tuple(read_protocol(tmp_path / ANSWERS).answers) == tuple(range(1, 18))


def test_the_program_is_written_and_never_over_another(tmp_path: Path) -> None:
    assert call("protocol", cwd=tmp_path).code == 0
    assert (tmp_path / MODULE).read_text() == questions()
    again = call("protocol", cwd=tmp_path)
    assert (again.code, again.err.splitlines()[0]) == (2, "error: Questions.mod is here already")
    checked = call("check", MODULE, "--robot", "irb1600", cwd=tmp_path)
    assert "error[" not in checked.out


def test_what_differs_is_marked_and_nothing_else_is_sent(tmp_path: Path) -> None:
    swing = float(run_protocol("irb1600").answers[20])
    written(tmp_path, {"1": "3", "10": "ERRNO 17", "20": f"{1.1 * swing:.3f}"})
    assert differing(tmp_path) == {
        "7.5 DIV 2": "differs",
        "an index of 1.5": "an error, too",
        "time of three swings": "+10.0 %",
    }
    packed = json.loads(call("protocol", ANSWERS, "--format", "json", cwd=tmp_path).out)
    controller = {"schema", "questions", "robotware", "robot", "real", "automatic", "speed"}
    assert packed.keys() == controller | {"answers"}
    assert packed["answers"]["1"] == "3"
    assert "16-12345" not in json.dumps(packed)


@pytest.mark.parametrize(
    ("changed", "why"),
    [({"automatic": "FALSE"}, "manual mode"), ({"speed": "50"}, "at 50 % speed")],
)
def test_slowed_moves_are_not_compared(changed: dict[str, str], why: str, tmp_path: Path) -> None:
    written(tmp_path, {"18": "9.9", "16": "9.9", **changed})
    found = differing(tmp_path)
    assert found["time of 20 moves of"] == f"not comparable: {why}"
    # Loops are as fast as ever.
    assert found["time of 10,000 round"].endswith(" %")


def test_the_arm_that_answered_answers_here(tmp_path: Path) -> None:
    written(tmp_path, {}, robot="IRB 120-3/0.6")
    shown = call("protocol", ANSWERS, cwd=tmp_path, columns=200).out
    assert "rapidsim, irb120-3-0.58" in shown
    assert arm_of(Protocol("6", "IRB 4600-40/2.55 Type A", "?", "?", "?", {})) == "irb4600-40-2.55"
    assert arm_of(Protocol("6", "IRB 9999-1/1.0", "?", "?", "?", {})) is None
    assert arm_of(Protocol("6", "virtual", "?", "?", "?", {})) is None


def test_another_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("1;3\n")
    ended = call("protocol", "notes.txt", cwd=tmp_path)
    assert ended.code == 2
    assert "does not hold answers to the questions" in ended.err
