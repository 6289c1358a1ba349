"""Devices of a cell on their own time: fingers, belts and their objects, queues of messages."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rapidsim.controller.cell.conditions import read_condition
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.controller.cell.conveyors import ConveyorState
from rapidsim.controller.cell.finger_motion import Fingers
from rapidsim.controller.cell.message_queues import (
    DeliveryResult,
    MessageQueue,
    MessageQueues,
    QueueMode,
    QueueSettings,
    QueueType,
)
from rapidsim.controller.queue.zone_table import _axes_within, _holds
from rapidsim.language import error_numbers as errors
from rapidsim.language.data import NO_EXTERNAL_AXES, JointTarget, Pos, RobJoint
from rapidsim.language.errors import RapidError
from rapidsim.language.messages import Message, MessageKind
from rapidsim.language.path_events import AxisRange, Cuboid, Cylinder, Sphere


def test_fingers_move_at_their_speed_and_stop_where_they_are() -> None:
    fingers = Fingers(speed_mm_s=10.0)
    assert (fingers.position(5.0), fingers.speed(5.0)) == (0.0, 0.0)
    fingers.move(20.0, 1.0)
    assert fingers.rest_s == pytest.approx(3.0)
    assert [fingers.position(at) for at in (1.0, 1.5, 2.0, 3.0, 9.0)] == [
        0.0,
        5.0,
        10.0,
        20.0,
        20.0,
    ]
    assert [fingers.speed(at) for at in (0.5, 1.0, 2.9, 3.0)] == [
        0.0,
        10.0,
        pytest.approx(10.0),
        0.0,
    ]
    # Back from half way, at another speed.
    fingers.speed_mm_s = 5.0
    fingers.move(0.0, 2.0)
    assert fingers.position(2.5) == pytest.approx(7.5)
    assert fingers.speed(2.5) == pytest.approx(5.0)
    assert fingers.rest_s == pytest.approx(4.0)
    fingers.stop(3.0)
    assert fingers.position(9.0) == pytest.approx(5.0)
    assert fingers.speed(3.5) == 0.0
    assert fingers.rest_s == 3.0
    fingers.stop(9.0)
    assert fingers.rest_s == 3.0


LEVELS = {"diRun": 1.0, "diDrop": 0.0, "diClear": 0.0}


class Belt:
    """A conveyor, with signals that tests set and what it asks of them."""

    def __init__(self, script: ConveyorScript) -> None:
        self.levels = dict(LEVELS)
        self.scheduled: list[tuple[str, float, Callable[[float], bool]]] = []
        self.shown: list[tuple[str, float, float]] = []
        self.state = ConveyorState(script, self.levels.__getitem__)
        self.state.begin(
            lambda *pulse: self.scheduled.append(pulse), lambda *show: self.shown.append(show)
        )

    def set(self, signal: str, value: float, now_s: float) -> None:
        old, self.levels[signal] = self.levels[signal], value
        self.state.signal_changed(signal, old, value, now_s)


SCRIPT = ConveyorScript(unit="CNV1", speed_mm_s=200.0, first_s=1.0, every_s=2.0, length_mm=1000.0)


def test_objects_come_at_their_distances_and_are_lost_behind_the_end() -> None:
    belt = Belt(SCRIPT).state
    assert not belt.stops
    assert not belt.is_wired
    assert not belt.shows_connection
    assert belt.next_s(0.0, 0.0) == pytest.approx(1.0)
    assert belt.next_s(0.0, 100.0) == pytest.approx(1.5)
    assert belt.next_s(2.0, 100.0) == pytest.approx(1.5)
    assert belt.passed_m is None
    belt.connect(2.0)
    assert belt.is_connected
    assert belt.passed_m == pytest.approx(0.2)
    assert belt.leaves_s() == pytest.approx(6.0)
    # The one at 3 s is lost at 8 s.
    assert belt.next_s(7.9, 0.0) == pytest.approx(3.0)
    assert belt.next_s(8.1, 0.0) == pytest.approx(5.0)
    belt.drop(8.1)
    assert not belt.is_connected
    only = Belt(replace(SCRIPT, every_s=None, most=300.0)).state
    only.connect(1.0)
    assert only.leaves_s() == pytest.approx(1.0 + 300.0 / 200.0)
    assert only.next_s(1.0, 0.0) is None


def test_a_belt_that_stands_takes_nothing_along() -> None:
    belt = Belt(replace(SCRIPT, runs=read_condition("diRun")))
    state = belt.state
    assert state.stops
    assert state.is_wired
    assert state.listens_to("DIRUN")
    assert not state.listens_to("diDrop")
    belt.set("diRun", 0.0, 0.4)
    assert state.next_s(0.4, 0.0) == math.inf
    assert state.next_s(0.5, -200.0) == pytest.approx(0.1)
    belt.set("diRun", 1.0, 2.4)
    assert state.next_s(2.4, 0.0) == pytest.approx(3.0)
    assert [row[0] for row in state.course.speeds] == [0.0, 0.4, 2.4]
    assert [row[1] for row in state.course.speeds] == pytest.approx([0.0, 0.08, 0.08])
    assert [row[2] for row in state.course.speeds] == [0.2, 0.0, 0.2]


def test_signals_drop_an_object_and_remove_those_that_wait() -> None:
    belt = Belt(
        replace(
            SCRIPT,
            drops=read_condition("diDrop"),
            clears=read_condition("diClear"),
            connected="diOn",
        )
    )
    state = belt.state
    assert state.shows_connection
    state.connect(1.2)
    assert belt.shown == [("diOn", 1.0, 1.2)]
    belt.set("diDrop", 1.0, 1.5)
    assert not state.is_connected
    assert belt.shown[1:] == [("diOn", 0.0, 1.5)]
    state.connect(3.5)
    belt.set("diClear", 0.0, 3.6)
    assert state.is_connected
    belt.set("diDrop", 0.0, 3.7)
    belt.set("diDrop", 1.0, 3.8)
    assert not state.is_connected
    # Objects of 5 and 7 s have passed the switch at 7.5 s, that of 9 s has not.
    belt.set("diClear", 1.0, 7.5)
    assert state.next_s(7.5, 0.0) == pytest.approx(9.0)


def test_the_switch_pulses_for_each_object_while_the_belt_runs() -> None:
    belt = Belt(replace(SCRIPT, runs=read_condition("diRun"), switch="diSync"))
    ((signal, time_s, passes),) = belt.scheduled
    assert signal == "diSync"
    assert time_s == pytest.approx(1.0)
    assert passes(1.0)
    assert belt.scheduled[1][1] == pytest.approx(3.0)
    belt.set("diRun", 0.0, 2.0)
    assert len(belt.scheduled) == 2
    belt.set("diRun", 1.0, 4.0)
    assert belt.scheduled[2][1] == pytest.approx(5.0)
    # The pulse of before the stop is none any more.
    assert not belt.scheduled[1][2](3.0)
    assert belt.scheduled[2][2](5.0)
    assert belt.scheduled[3][1] == pytest.approx(7.0)


NUMBER = MessageKind("num")


def message(sender: MessageQueue | None = None, text: str = "1") -> Message:
    return Message(NUMBER, text, sender)


def error_of(ask: Callable[[], object]) -> tuple[float, str]:
    with pytest.raises(RapidError) as caught:
        ask()
    return caught.value.errno, caught.value.message


def test_a_queue_takes_what_fits_as_long_as_it_is_open() -> None:
    queue = MessageQueue("RMQ_A", QueueSettings(max_bytes=400, max_messages=2))
    assert queue.put(message(), 0.0) is DeliveryResult.KEPT
    assert queue.put(message(text="2" * 396), 0.0) is DeliveryResult.KEPT
    assert error_of(lambda: queue.put(message(), 0.0)) == (
        errors.ERR_RMQ_FULL,
        "RMQ_A holds 2 messages and takes no more",
    )
    assert error_of(lambda: queue.put(message(text="2" * 397), 0.0)) == (
        errors.ERR_RMQ_MSGSIZE,
        "the message has 401 bytes; RMQ_A takes 400",
    )
    queue.is_open = False
    assert error_of(lambda: queue.put(message(), 0.0)) == (
        errors.ERR_RMQ_INVALID,
        "RMQ_A has disconnected",
    )
    queue.is_absent = True
    assert queue.put(message(), 0.0) is DeliveryResult.LOST


@pytest.mark.parametrize(
    ("mode", "raises", "result", "asked"),
    [
        (None, False, DeliveryResult.KEPT, 1),
        (None, True, DeliveryResult.KEPT, 1),
        (QueueMode.INTERRUPT, True, DeliveryResult.KEPT, 1),
        (QueueMode.INTERRUPT, False, DeliveryResult.DISCARDED, 1),
        (QueueMode.SYNCHRONOUS, True, DeliveryResult.KEPT, 0),
    ],
)
def test_a_message_raises_interrupts_unless_it_is_waited_for(
    mode: QueueMode | None, raises: bool, result: DeliveryResult, asked: int
) -> None:
    times: list[float] = []

    def interrupts(_: Message, now_s: float) -> bool:
        times.append(now_s)
        return raises

    queue = MessageQueue("RMQ_A", QueueSettings(mode=mode), raises_interrupt=interrupts)
    assert queue.put(message(), 2.5) is result
    assert times == [2.5] * asked
    assert len(queue.messages) == (result is DeliveryResult.KEPT)


def test_an_answer_is_the_first_of_its_kind_from_its_sender() -> None:
    other, peer = (MessageQueue(name, QueueSettings()) for name in ("other", "peer"))
    queue = MessageQueue("RMQ_A", QueueSettings())
    assert queue.answer is None
    queue.await_answer(peer, NUMBER)
    assert queue.put(message(other), 0.0) is DeliveryResult.KEPT
    assert queue.put(Message(MessageKind("num", (2,)), "[1,2]", peer), 0.0) is DeliveryResult.KEPT
    assert queue.answer is None
    answer = message(peer)
    assert queue.put(answer, 0.0) is DeliveryResult.ANSWERS
    assert queue.put(message(peer), 0.0) is DeliveryResult.KEPT
    assert queue.answer is answer
    queue.forget_answer()
    assert queue.answer is None
    assert NUMBER.fits(MessageKind("NUM"))
    assert not NUMBER.fits(MessageKind("bool"))
    assert (MessageKind("num", (2, 3)).spelled, NUMBER.spelled) == ("num{2,3}", "num")


def test_queues_are_found_by_those_who_may_send_to_them() -> None:
    queues = MessageQueues(frozenset({"RMQ_B"}))
    first = queues.open_for("A", QueueSettings())
    inner = queues.open_for("I", QueueSettings(type=QueueType.INTERNAL))
    queues.open_for("N", QueueSettings(type=QueueType.NONE))
    client = queues.connect("pc", 3)
    assert queues.connect("pc") is client
    assert (client.settings.max_messages, client.settings.max_bytes) == (3, 3000)
    assert client.settings.mode is QueueMode.SYNCHRONOUS
    assert queues.find("RMQ_A") is first
    assert queues.find("RMQ_A", is_external=True) is first
    assert queues.find("RMQ_I") is inner
    for name, is_external in (
        *(("RMQ_I", True), ("RMQ_N", False), ("rmq_a", False), ("RMQ_B", True)),
    ):
        assert queues.find(name, is_external=is_external) is None
    absent = queues.find("RMQ_B")
    assert absent is not None
    assert absent.is_absent
    assert not queues.open_for("B", QueueSettings()).is_absent
    found = queues.find("RMQ_B")
    assert found is not None
    assert not found.is_absent
    again = queues.open_for("A", QueueSettings())
    assert not first.is_open
    assert queues.find("RMQ_A") is again
    queues.disconnect("pc")
    assert not client.is_open
    assert queues.find("pc") is None


POINTS = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 0.0, 30.0], [0.0, 11.0, 5.0]])


@pytest.mark.parametrize(
    ("volume", "inside"),
    [
        (Cuboid(Pos(-1.0, -1.0, -1.0), Pos(10.0, 1.0, 30.0)), [True, True, True, False]),
        (Cuboid(Pos(10.0, 1.0, 5.0), Pos(-1.0, -1.0, -1.0)), [True, True, False, False]),
        (Cylinder(Pos(0.0, 0.0, 0.0), 10.0, 30.0), [True, True, True, False]),
        (Cylinder(Pos(0.0, 0.0, 30.0), 10.0, -29.0), [False, False, True, False]),
        (Cylinder(Pos(0.0, 0.0, 0.0), 12.0, 4.0), [True, True, False, False]),
        (Sphere(Pos(0.0, 0.0, 0.0), 10.0), [True, True, False, False]),
        (Sphere(Pos(0.0, 1.0, 0.0), 11.2), [True, True, False, True]),
    ],
)
def test_a_volume_contains_its_borders(
    volume: Cuboid | Cylinder | Sphere, inside: list[bool]
) -> None:
    assert _holds(volume, POINTS).tolist() == inside


def test_axes_are_between_two_joint_targets_with_both() -> None:
    low = JointTarget(RobJoint(-10.0, *[-90.0] * 5), NO_EXTERNAL_AXES)
    high = JointTarget(RobJoint(10.0, *[90.0] * 5), NO_EXTERNAL_AXES)
    rows = np.array([[-10.0, 90, 0, 0, 0, 0], [10.0, 0, -90, 0, 0, 0], [11.0] + [0.0] * 5])
    assert _axes_within(AxisRange(low, high), rows).tolist() == [True, True, False]
    assert _axes_within(AxisRange(low, high), rows[:, :4]).tolist() == [True, True, False]
    rows[0, 5] = -91.0
    assert _axes_within(AxisRange(low, high), rows).tolist() == [False, True, False]
