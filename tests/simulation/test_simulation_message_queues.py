"""Queues of clients outside the controller, and how a cell describes those of tasks."""

from pathlib import Path
from typing import Any, cast

import pytest

from rapidsim.controller.cell.message_queues import (
    DeliveryResult,
    MessageQueues,
    QueueMode,
    QueueSettings,
    QueueType,
)
from rapidsim.files import InputError
from rapidsim.language.controller import FidelityReporter
from rapidsim.language.data import Pos
from rapidsim.language.errors import RapidError
from rapidsim.language.messages import Message, MessageKind
from rapidsim.language.records import record_of
from rapidsim.language.reference import Box
from rapidsim.language.types import NUM, STRING, ArrayOf, Type
from rapidsim.library.messages import rmq_get_msg_data
from rapidsim.station.backup.cfg_file import read_configuration
from rapidsim.station.backup.tasks import configured_tasks
from rapidsim.station.read import read_station

POS = record_of(Pos)


def read(message: Message, data: Any, of: Type) -> object:
    rmq_get_msg_data(cast(FidelityReporter, None), Box(message), data, of=of)
    return data if isinstance(data, list) else data.value


def test_a_client_outside_is_a_queue_that_tasks_can_find() -> None:
    queues = MessageQueues()
    task = queues.open_for("T_ROB1", QueueSettings(mode=QueueMode.SYNCHRONOUS))
    client = queues.connect("client")
    assert queues.find("client") is client
    assert queues.find("RMQ_T_ROB1", is_external=True) is task
    assert task.put(Message(MessageKind("num"), "5", sender=client), 1.0) is DeliveryResult.KEPT
    queues.disconnect("client")
    assert queues.find("client") is None
    with pytest.raises(RapidError, match="client has disconnected"):
        client.put(Message(MessageKind("num"), "5"), 2.0)


@pytest.mark.parametrize(
    ("kind", "found"),
    [(QueueType.NONE, ""), (QueueType.INTERNAL, "task"), (QueueType.REMOTE, "both")],
)
def test_the_type_of_a_queue_says_who_finds_it(kind: QueueType, found: str) -> None:
    queues = MessageQueues()
    queues.open_for("T_ROB1", QueueSettings(kind))
    assert (queues.find("RMQ_T_ROB1") is not None) == (found != "")
    outside = queues.find("RMQ_T_ROB1", is_external=True)
    assert (outside is not None) == (found == "both")


def test_what_comes_as_text_is_read_as_the_type_of_the_data() -> None:
    assert read(Message(MessageKind("num"), "5"), Box(0.0), NUM) == 5.0
    assert read(Message(MessageKind("POS"), "[1,2,3]"), Box(Pos(0, 0, 0)), POS) == Pos(1, 2, 3)
    two = Message(MessageKind("string", (2,)), '["a","b""c"]')
    assert read(two, ["", ""], ArrayOf(STRING, (2,))) == ["a", 'b"c']
    for text in ("", "[", "1e999999x", "[[1]]", '"a'):
        with pytest.raises(RapidError, match="is no num"):
            read(Message(MessageKind("num"), text), Box(0.0), NUM)


def test_a_station_describes_the_queue_of_a_task(tmp_path: Path) -> None:
    file = tmp_path / "rapidsim.toml"
    file.write_text(
        '[[task]]\nname = "T_ROB1"\n'
        'rmq = { type = "Remote", mode = "synchronous", size = 3000, messages = 10 }\n'
        '[[task]]\nname = "T_ROB2"\n'
    )
    first, second = read_station(file).tasks
    assert first.queue == QueueSettings(QueueType.REMOTE, QueueMode.SYNCHRONOUS, 3000, 10)
    assert second.queue is None


@pytest.mark.parametrize(
    "rmq", ['{ type = "all" }', '{ mode = "both" }', "{ size = 399 }", "{ messages = 2.5 }", "3"]
)
def test_a_queue_that_no_controller_has_is_refused(rmq: str, tmp_path: Path) -> None:
    file = tmp_path / "rapidsim.toml"
    file.write_text(f'[[task]]\nname = "T_ROB1"\nrmq = {rmq}\n')
    with pytest.raises(InputError, match=r"task.*rmq"):
        read_station(file)


def test_a_configuration_gives_no_queue_unless_it_says_so() -> None:
    tasks = configured_tasks(
        read_configuration(
            'CAB_TASKS:\n-Name "T_ROB1" -RmqType "Remote" -RmqMode "Synchronous"\\\n'
            '-RmqMaxMsgSize 800 -RmqMaxNoOfMsg 7\n-Name "T_BACK"\n'
        )
    )
    assert tasks["t_rob1"].queue == QueueSettings(QueueType.REMOTE, QueueMode.SYNCHRONOUS, 800, 7)
    assert tasks["t_back"].queue == QueueSettings(QueueType.NONE, QueueMode.INTERRUPT)


def test_a_task_that_is_not_in_the_run_loses_what_it_is_sent() -> None:
    queues = MessageQueues(frozenset({"RMQ_T_ROB2"}))
    absent = queues.find("RMQ_T_ROB2")
    assert absent is not None
    assert absent.put(Message(MessageKind("num"), "5"), 0.0) is DeliveryResult.LOST
    assert queues.find("RMQ_T_ROB3") is None
    queues.open_for("T_ROB2", QueueSettings(mode=QueueMode.SYNCHRONOUS))
    there = queues.find("RMQ_T_ROB2")
    assert there is not None
    assert there.put(Message(MessageKind("num"), "5"), 0.0) is DeliveryResult.KEPT
