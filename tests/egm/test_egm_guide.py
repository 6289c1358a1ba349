"""A guide beside the controller: frames go out by themselves, and both have the same motion."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import replace
from multiprocessing import Pipe
from threading import Thread
from time import monotonic
from typing import Any

import numpy as np
import pytest

from rapidsim.controller.cell.sensors import FeedbackSchedule
from rapidsim.egm.codec import decode, encode
from rapidsim.egm.devices import Address, sensor_devices
from rapidsim.egm.guided_sensors import GuidedSensors
from rapidsim.egm.messages import PATH_CORRECTION, ROBOT, SENSOR, MessageType
from rapidsim.egm.sensor_loop import serve_sensors
from rapidsim.frames.transform import Transform
from rapidsim.motion.guidance.feedback import (
    Frames,
    Guided,
    GuidedFeedback,
    ProgramData,
    standing_feedback,
)
from rapidsim.motion.guidance.goals import Band, JointGoal
from rapidsim.motion.guidance.guided_execution import EndConditions, EndReason, GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.robot.robot import load_robot

GOAL = (2.0, -1.0, 1.0, 0.0, 31.0, 3.0)


@contextmanager
def guided() -> Iterator[tuple[GuidedSensors, socket.socket]]:
    """A guide in a thread, and the sensor that it talks to."""
    ours, theirs = Pipe()
    sensor = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sensor.bind(("127.0.0.1", 0))
    sensor.settimeout(10.0)
    devices = sensor_devices([("dev", Address(*sensor.getsockname()))], {}, frozenset())
    thread = Thread(target=serve_sensors, args=(theirs,))
    thread.start()
    yield GuidedSensors(devices, ours, 1.0, monotonic()), sensor
    ours.close()
    thread.join()
    theirs.close()
    sensor.close()


def begun() -> tuple[GuidedExecution, GuidedFeedback]:
    robot = load_robot("irb1600")
    start = robot.start
    near = np.full(6, np.radians(0.01))
    axes = GuidedAxes(robot.lower, robot.upper, np.full(6, 2.0), np.full(6, 10.0))
    run = GuidedExecution(
        JointMotion(axes, start, np.zeros(6)),
        JointGoal(Band(np.ones(6, dtype=np.bool_), -near, near), (50.0,), start),
        Tuning(20.0),
        EndConditions(0.05, 0.05, 30.0, False, 0.0),
    )
    frames = Frames(robot.kinematics, Transform.identity(), Transform.identity())
    return run, GuidedFeedback(frames, ())


def heard(sensor: socket.socket) -> tuple[dict[str, Any], Any]:
    data, controller = sensor.recvfrom(65536)
    return decode(ROBOT, data), controller


def test_the_controller_has_the_motion_that_the_sensor_was_told_of() -> None:
    # The controller asks for nothing until the sensor has seen the robot come to its end.
    run, feedback = begun()
    answer = encode(SENSOR, {"planned": {"joints": {"joints": GOAL}}})
    with guided() as (sensors, sensor):
        one = sensors.open("dev")
        one.begin(deepcopy(run), FeedbackSchedule(0.1, 2, feedback))
        frames: list[dict[str, Any]] = []
        while not frames or frames[-1]["mciConvergenceMet"] == 0:
            frame, controller = heard(sensor)
            frames.append(frame)
            sensor.sendto(answer, controller)
            sensor.sendto(b"\xff\xff", controller)
        cycles = 0
        while not run.is_over:
            told = feedback(run, 0.1 + cycles * CYCLE_S)
            if cycles % 2 == 0 and cycles // 2 < len(frames):
                joints = frames[cycles // 2]["feedBack"]["joints"]["joints"]
                assert tuple(joints) == told.joints
            run.step(one.exchange(told) if cycles % 2 == 0 else None)
            cycles += 1
        one.end(feedback(run, 0.1 + cycles * CYCLE_S))
        while frames[-1]["mciState"]["state"] != 2:
            frames.append(heard(sensor)[0])
        one.close()
    assert run.ended is EndReason.CONVERGED
    assert [one["header"]["seqno"] for one in frames] == list(range(len(frames)))
    assert frames[-1]["feedBack"]["joints"]["joints"] == pytest.approx(GOAL, abs=0.01)


def test_a_stream_goes_on_where_the_controller_says_nothing_new() -> None:
    run, feedback = begun()
    stream = [
        standing_feedback(feedback.frames, 0.004 * k, run.start + 0.01 * k, (), Guided.NOT_YET, 0.0)
        for k in range(5)
    ]
    with guided() as (sensors, sensor):
        one = sensors.open("dev")
        one.stream(stream)
        frames = [heard(sensor)[0] for _ in range(8)]
        one.close()
    first = frames[0]["header"]["tm"]
    assert [one["header"]["tm"] - first for one in frames] == [4 * k for k in range(8)]
    joints = [one["feedBack"]["joints"]["joints"] for one in frames]
    assert joints[4:] == [list(stream[4].joints)] * 4
    assert {one["mciState"]["state"] for one in frames} == {2}


def test_what_is_streamed_of_a_corrected_path_is_answered() -> None:
    # The answer to a word comes to the controller with the next sample.
    run, feedback = begun()
    words = [
        standing_feedback(feedback.frames, 0.024 * k, run.start, (), Guided.RUNNING, 0.0)
        for k in range(4)
    ]
    with guided() as (sensors, sensor):
        one = sensors.open("dev")
        one.correct(0.0, 0.024)
        one.stream(words)
        for y_mm in (1.0, 2.0, 3.0):
            _, controller = heard(sensor)
            sensor.sendto(correction(y_mm), controller)
        answers = [one.exchange(word) for word in words]
        one.end(words[-1])
        one.close()
    assert [answer and answer.correction for answer in answers] == [
        None,
        *[(0.0, y_mm, 0.0) for y_mm in (1.0, 2.0, 3.0)],
    ]


def test_what_is_said_during_the_stream_begins_the_first_guidance_only() -> None:
    # A client may name its goal once, while the program still moves the robot.
    run, feedback = begun()
    word = standing_feedback(feedback.frames, 0.0, run.start, (), Guided.NOT_YET, 0.0)
    answer = encode(SENSOR, {"planned": {"joints": {"joints": GOAL}}})
    answers = []
    with guided() as (sensors, sensor):
        one = sensors.open("dev")
        for _ in range(2):
            one.stream([word])
            _, controller = heard(sensor)
            sensor.sendto(answer, controller)
            one.begin(deepcopy(run), FeedbackSchedule(0.1, 1, feedback))
            answers.append(one.exchange(feedback(run, 0.1)))
            one.end(word)
        one.close()
        other = sensors.open("dev")
        other.begin(deepcopy(run), FeedbackSchedule(0.1, 1, feedback))
        answers.append(other.exchange(feedback(run, 0.1)))
        other.close()
    assert [answer and answer.joints for answer in answers] == [GOAL, None, None]


def correction(y_mm: float) -> bytes:
    told = {"pos": {"x": 0.0, "y": y_mm, "z": 0.0}, "age": 1}
    kind = {"mtype": MessageType.PATH_CORRECTION}
    return encode(PATH_CORRECTION, {"header": kind, "pathCorr": told})


def test_a_guide_that_is_gone_is_a_silent_sensor() -> None:
    run, feedback = begun()
    with guided() as (sensors, _):
        one = sensors.open("dev")
        sensors.connection.close()
        one.begin(run, FeedbackSchedule(0.0, 1, feedback))
        assert one.exchange(feedback(run, 0.0)) is None


def test_data_of_the_program_go_with_all_messages_from_then_on() -> None:
    # The guide has them with its orders; the controller need not be on time.
    run, feedback = begun()
    with guided() as (sensors, sensor):
        one = sensors.open("dev")
        one.begin(deepcopy(run), FeedbackSchedule(0.1, 2, feedback, ProgramData(False, (1.0,))))
        frame, _ = heard(sensor)
        assert frame["RAPIDfromRobot"] == {"digVal": 0, "dnum": [1.0]}
        changed = replace(feedback(run, 0.1), sent=ProgramData(True, (2.0, 3.0)))
        one.exchange(changed)
        while frame["RAPIDfromRobot"]["digVal"] == 0:
            frame, _ = heard(sensor)
        assert frame["RAPIDfromRobot"] == {"digVal": 1, "dnum": [2.0, 3.0]}
        assert frame["CollisionInfo"] == {"collsionTriggered": 0}
        one.end(changed)
