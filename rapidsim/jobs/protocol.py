"""Answers of a controller to `questions/Questions.mod`, and those of a run here.

The answers file has a line for each, `number;answer`, and three of the controller: version of the
questions, RobotWare, arm. Nothing else is kept of it, so that it can be sent to anybody.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from rapidsim.files import InputError, input_bytes
from rapidsim.jobs.run_files import simulate
from rapidsim.shipped import shipped
from rapidsim.simulation.options import RunOptions
from rapidsim.values import dataclass

MODULE = "Questions.mod"
ANSWERS = "rapidsim_answers.txt"
TOPICS: Mapping[int, str] = {
    1: "7.5 DIV 2",
    2: "7.5 MOD 2",
    3: r"bytes of a file opened twice, the second time with \Bin alone",
    4: "RETRY statements until the next clause is asked",
    5: "ERRNO after a routine with a clause of its own",
    6: "16777216 + 1",
    7: "0.1 + 0.2 as text",
    8: "Round of 2.5, -2.5 and 3.5",
    9: "a text of 81 characters",
    10: "an index of 1.5",
    11: "Dim of a dimension that the array lacks",
    12: "StrToVal of no number, and the number then",
    13: "CalcJointT, cf1 one quarter off",
    14: "CalcJointT, cf1 two quarters off",
    15: "CalcJointT, another cfx",
    16: "time of 10,000 rounds [s]",
    17: "time of 100 WaitTime 0 [s]",
    18: "time of 20 moves of 0.1 mm with fine [s]",
    19: "time of three picking cycles [s]",
    20: "time of three swings of axis 1 and back [s]",
}
_VERSION = "1"
_LONGEST = 80


@dataclass(frozen=True, slots=True)
class Protocol:
    """What one controller answered."""

    robotware: str
    robot: str
    answers: Mapping[int, str]
    """By number; a question that was not answered is missing."""

    def as_json(self) -> dict[str, object]:
        """The object to send."""
        answers = {str(number): self.answers[number] for number in sorted(self.answers)}
        return {
            "schema": 1,
            "questions": int(_VERSION),
            "robotware": self.robotware,
            "robot": self.robot,
            "answers": answers,
        }


def questions() -> str:
    """The text of the program."""
    return (shipped("questions") / MODULE).read_text(encoding="utf-8")


def read_protocol(file: Path) -> Protocol:
    """Read the answers that the program has written.

    Raises:
        InputError: If the file is missing, or is not one of answers.
    """
    lines = input_bytes(file).decode("latin-1").splitlines()
    fields: dict[str, str] = {}
    for line in lines:
        key, mark, value = line.partition(";")
        if mark:
            fields.setdefault(key.strip(), value.strip()[:_LONGEST])
    if fields.get("questions") != _VERSION:
        raise InputError(
            f"{file} does not hold answers to the questions",
            f"`rapidsim protocol` writes {MODULE}, which writes {ANSWERS} on a controller",
        )
    answers = {number: fields[str(number)] for number in TOPICS if str(number) in fields}
    return Protocol(fields.get("robotware", "?"), fields.get("robot", "?"), answers)


def answered_here(robot: str) -> Protocol:
    """What a run answers.

    Args:
        robot: The arm, by its name in the catalogue.

    Raises:
        RobotError: If the catalogue has no such robot.
    """
    with TemporaryDirectory(prefix="rapidsim-") as folder:
        home = Path(folder)
        simulate([shipped("questions") / MODULE], robot=robot, options=RunOptions(home=home))
        return read_protocol(home / ANSWERS)
