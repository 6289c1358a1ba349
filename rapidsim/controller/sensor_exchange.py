"""Data and signals that a program exchanges with a sensor beside goals and positions.

Both go with the messages: what the program sends is read at the instant of the message, and what
the sensor sends takes effect at the sample that its answer belongs to.
"""

from __future__ import annotations

from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.language.guidance import Exchange
from rapidsim.motion.guidance.feedback import ProgramData
from rapidsim.motion.guidance.sensor import SensorAnswer


def data_for_sensor(exchange: Exchange, cell: Cell) -> ProgramData:
    """Return the present data of the program for its sensor."""
    output = exchange.output_to
    digital = None if output is None else bool(cell.signals.read(output))
    return ProgramData(digital, tuple(map(float, exchange.numbers_to or ())))


def take_answer(
    exchange: Exchange, answer: SensorAnswer | None, cell: Cell, cause: Cause, now_s: float
) -> None:
    """Give the program the data in an answer, at a time [s]; numbers beyond its array are lost."""
    if answer is None:
        return
    numbers, moment = exchange.numbers_from, Moment(Instant(now_s))
    if numbers is not None and answer.values:
        numbers[: len(answer.values)] = answer.values[: len(numbers)]
        cell.notify(moment)
    if exchange.input_from is not None and answer.digital is not None:
        cell.set_signal(cause, moment, exchange.input_from, float(answer.digital))
