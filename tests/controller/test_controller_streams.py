"""Instants at which a sensor is told where the robot is."""

from __future__ import annotations

from typing import cast

import pytest

from rapidsim.controller.cell.sensors import GuidanceSensor
from rapidsim.controller.sensor_streams import SensorStream


class Sensor:
    """Notes when its answers begin to count."""

    def __init__(self, *, has_lookahead: bool) -> None:
        self.has_lookahead = has_lookahead
        self.corrected: list[tuple[float, float]] = []

    def correct(self, now_s: float, sample_s: float) -> None:
        self.corrected.append((now_s, sample_s))


def stream(*, ahead: bool, awaits: bool, begin_s: float) -> tuple[SensorStream, Sensor]:
    sensor = Sensor(has_lookahead=ahead)
    made = SensorStream(cast(GuidanceSensor, sensor), 0.008, 0.0, awaits=awaits)
    made.begin(begin_s)
    return made, sensor


@pytest.mark.parametrize(
    ("ahead", "samples"), [(False, [[0.104], [0.112]]), (True, [[0.104, 0.112, 0.120, 0.128, 0.136],
                                                        [0.112, 0.120, 0.128, 0.136, 0.144]])],
)  # fmt: skip
def test_awaited_answers_come_at_multiples_of_their_interval(
    ahead: bool, samples: list[list[float]]
) -> None:
    made, sensor = stream(ahead=ahead, awaits=True, begin_s=0.1)
    for wanted in samples:
        assert made._due().tolist() == pytest.approx(wanted)
    ((begins_s, every_s),) = sensor.corrected
    assert (begins_s, every_s) == pytest.approx((0.104, 0.008))


def test_what_is_not_answered_is_sent_in_one_go() -> None:
    made, sensor = stream(ahead=False, awaits=False, begin_s=0.1)
    assert sensor.corrected == []
    assert made._due().tolist() == pytest.approx([0.080, 0.088, 0.096])
    assert made._due().tolist() == pytest.approx([0.104, 0.112])
    early, _ = stream(ahead=False, awaits=False, begin_s=0.0)
    assert early._due().tolist() == []
    assert early._due().tolist() == pytest.approx([0.0, 0.008, 0.016])
    ahead, _ = stream(ahead=True, awaits=False, begin_s=0.1)
    wanted = [0.104, 0.112, 0.120, 0.128, 0.136, 0.144, 0.152]
    assert ahead._due().tolist() == pytest.approx(wanted)
