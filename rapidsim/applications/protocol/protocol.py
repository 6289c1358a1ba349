"""Answers of a controller to `questions/Questions.mod`, and those of a simulated run.

The answers file has a line for each, `number;answer`, of which the last counts, and lines for the
controller: version of the questions, RobotWare, arm, whether it is a real one, in automatic mode,
and its speed. It contains nothing else, so that it can be published.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import ClassVar

from rapidsim.files import InputError, input_bytes
from rapidsim.jobs.running.run_files import simulate
from rapidsim.json_records.declarations import OutputRecord
from rapidsim.language.error_numbers import NUMBERS
from rapidsim.shipped import shipped
from rapidsim.simulation.options import RunOptions
from rapidsim.values import value_class

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
TIMED = frozenset({16, 17, 18, 19, 20})
"""Questions whose answers are times [s]."""
_MOVING = frozenset({18, 19, 20})
_VERSION = "2"
_FULL_SPEED = "100"
_SAME_ARM = 0.1
"""Largest relative deviation of a type's reach and payload from the catalogue: 0.6 m for 0.58."""
_NAMES = {number: name for name, number in NUMBERS.items()}
_NUMBER = re.compile(r"ERRNO (\d+)")
_LONGEST = 80


@value_class(frozen=True, slots=True)
class Protocol(OutputRecord):
    """Answers of one controller, and the object that `rapidsim protocol --format json` prints."""

    questions: ClassVar[int] = int(_VERSION)
    """Version of the questions."""
    robotware: str
    """Version of the controller that answered."""
    robot: str
    """Type of its arm."""
    real: str
    """`TRUE` for a real controller, `FALSE` for a virtual one, `?` if unknown."""
    automatic: str
    """`TRUE` in automatic mode, `?` if unknown; in manual mode moves are slower."""
    speed: str
    """Speed that the operator has set [%], `?` if unknown."""
    answers: Mapping[int, str]
    """Answers by number; without questions that were not answered."""

    def why_not_timed(self, number: int) -> str | None:
        """Reason why the time of a question is not comparable; None if it is comparable."""
        if number not in _MOVING:
            return None
        if self.automatic == "FALSE":
            return "manual mode"
        return None if self.speed in (_FULL_SPEED, "?") else f"at {self.speed} % speed"


def questions() -> str:
    """Return the text of the program."""
    return (shipped("questions") / MODULE).read_text(encoding="utf-8")


def read_protocol(file: Path) -> Protocol:
    """Read the answers that the program has written.

    Raises:
        InputError: If the file is missing, or does not contain answers.
    """
    lines = input_bytes(file).decode("latin-1").splitlines()
    fields: dict[str, str] = {}
    for line in lines:
        key, mark, value = line.partition(";")
        if mark:
            fields[key.strip()] = value.strip()[:_LONGEST]
    if fields.get("questions") != _VERSION:
        raise InputError(
            f"{file} does not hold answers to the questions",
            f"`rapidsim protocol` writes {MODULE}, which writes {ANSWERS} on a controller",
        )
    answers = {number: fields[str(number)] for number in TOPICS if str(number) in fields}
    keys = ("robotware", "robot", "real", "automatic", "speed")
    texts = {key: fields.get(key, "?") for key in keys}
    return Protocol(**texts, answers=answers)


def arm_of(protocol: Protocol) -> str | None:
    """Return the catalogue's name of the arm that answered; None if its type is not conclusive."""
    # Without answers to compare no arm is ranked.
    from rapidsim.motion.robot.catalogue import robot_names
    from rapidsim.reach.arm_ranking import hints_of

    near = [
        (hint.deviation(name), name)
        for hint in hints_of([protocol.robot])
        if hint.figures
        for name in robot_names()
    ]
    deviation, name = min(near, default=(1.0, ""))
    return name if deviation <= _SAME_ARM else None


def run_protocol(robot: str) -> Protocol:
    """Return the answers of a simulated run.

    Args:
        robot: The arm, by its name in the catalogue.

    Raises:
        RobotError: If the catalogue has no such robot.
    """
    with TemporaryDirectory(prefix="rapidsim-") as folder:
        home = Path(folder)
        simulate([shipped("questions") / MODULE], robot=robot, options=RunOptions(home=home))
        answered = read_protocol(home / ANSWERS)
    answers = {
        number: _NUMBER.sub(lambda found: f"ERRNO of {_NAMES[float(found[1])]}", text)
        for number, text in answered.answers.items()
    }
    return replace(answered, answers=answers)
