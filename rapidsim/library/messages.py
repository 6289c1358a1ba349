r"""RAPID message queues: messages between tasks, by interrupts or in turn.

A task takes messages in interrupt mode or in synchronous mode; an instruction of the other mode
stops the program. If neither SYS.cfg nor the station file selects the mode, both work, which the
first use of RMQReadWait reports. \Index has no effect.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "RMQFindSlot",
"RMQSendMessage", "RMQSendWait", "RMQGetMessage", "RMQGetMsgHeader", "RMQGetMsgData",
"RMQReadWait", "RMQEmptyQueue", "IRMQMessage". No source states that RMQSendWait takes the next
message of the type from the slot that it sent to as the answer; this is our interpretation.
"""

from __future__ import annotations

from typing import Annotated, Any

from rapidsim.language.annotations import (
    AnyType,
    ArgumentType,
    IntNum,
    Num,
    Ref,
    RmqMessage,
    RmqSlot,
    String,
    Var,
)
from rapidsim.language.controller import Controller, FidelityReporter
from rapidsim.language.data import RmqHeader
from rapidsim.language.error_numbers import (
    ERR_RMQ_DIM,
    ERR_RMQ_INVALID,
    ERR_RMQ_INVMSG,
    ERR_RMQ_MSGSIZE,
    ERR_RMQ_NAME,
    ERR_RMQ_NOMSG,
    ERR_RMQ_TIMEOUT,
    ERR_RMQ_VALUE,
    rapid_error,
)
from rapidsim.language.errors import NotAllowed
from rapidsim.language.messages import MOST_BYTES, NO_USER_DEF, Message, MessageKind, Messages, Slot
from rapidsim.language.reference import Reference
from rapidsim.language.types import NUM, ArrayOf, Atomic, Kind, Record, Type, resolved
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.sockets import DEFAULT_TIME_S, WAIT_FOR_EVER_S
from rapidsim.library.table import routine, table
from rapidsim.library.text import element_count, parsed_value, value_text
from rapidsim.library.traits import Trait


def rmq_find_slot(controller: Messages, slot: Var[RmqSlot], name: String) -> None:
    """Find the queue of a task, `RMQ_` and its name, or of a client; case counts."""
    found = controller.find_queue(name)
    if found is None:
        raise rapid_error(ERR_RMQ_NAME, f"there is no message queue {name}")
    slot.value = found


def rmq_get_slot_name(controller: Messages, slot: Var[RmqSlot]) -> String:
    """The name of a queue."""
    found = _connected(slot)
    if not controller.is_open(found):
        raise rapid_error(ERR_RMQ_INVALID, f"{found.name} has disconnected")
    return found.name


def rmq_send_message(
    controller: Messages,
    slot: Var[RmqSlot],
    send_data: Ref[AnyType],
    *,
    user_def: Num | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Send data to a queue."""
    message = _message(controller, send_data, of, user_def)
    controller.send_message(_connected(slot), message)


def rmq_send_wait(
    controller: Controller,
    slot: Var[RmqSlot],
    send_data: Ref[AnyType],
    message: Var[RmqMessage],
    receive_data_type: Ref[AnyType],
    *,
    user_def: Num | None = None,
    timeout: Num | None = None,
    of: ArgumentType = NUM,
    answer_of: ArgumentType = NUM,
) -> None:
    """Send data to a queue and wait for an answer of a type, 60 s by default."""
    messages = controller.messages
    _require(controller, "RMQSendWait", synchronous=False, in_trap=False)
    sent = _message(messages, send_data, of, user_def)
    kind = _kind(receive_data_type, answer_of)
    target = _connected(slot)
    found = messages.await_answer(target, sent, kind, max_time=_limit(timeout))
    if found is None:
        raise _out_of_time(f"no answer of type {kind.spelled} from {target.name}", timeout)
    message.value = found


def rmq_read_wait(
    controller: Controller, message: Var[RmqMessage], *, time_out: Num | None = None
) -> None:
    """Take the next message, waiting for it, 60 s by default."""
    if controller.messages.is_synchronous is None:
        controller.fidelity.not_simulated(
            "RMQReadWait", "as in synchronous mode: the mode of the task's queue is not described"
        )
    _require(controller, "RMQReadWait", synchronous=True, in_trap=False)
    found = controller.messages.await_message(max_time=_limit(time_out))
    if found is None:
        raise _out_of_time("no message", time_out)
    message.value = found


def rmq_get_message(controller: Controller, message: Var[RmqMessage]) -> None:
    """Take the next message in the trap that it has raised."""
    _require(controller, "RMQGetMessage", synchronous=False, in_trap=True)
    found = controller.messages.next_message()
    if found is None:
        raise rapid_error(ERR_RMQ_NOMSG, "there is no message in the queue")
    message.value = found


def rmq_get_msg_header(
    message: Var[RmqMessage],
    *,
    header: Var[RmqHeader] | None = None,
    sender_id: Var[RmqSlot] | None = None,
    user_def: Var[Num] | None = None,
) -> None:
    r"""The type of a message, its sender, and its \UserDef, -1 without one."""
    found = _received(message)
    if header is not None:
        dimensions = (*map(float, found.kind.dimensions), 0.0, 0.0, 0.0)[:3]
        count = float(len(found.kind.dimensions))
        header.value = RmqHeader(found.kind.data_type, count, *dimensions)
    if sender_id is not None:
        sender_id.value = found.sender
    if user_def is not None:
        user_def.value = found.user_def


def rmq_get_msg_data(
    controller: FidelityReporter,
    message: Var[RmqMessage],
    data: Var[AnyType],
    *,
    index: Num | None = None,
    of: ArgumentType = NUM,
) -> None:
    """The data of a message, into data of the same type and dimensions."""
    note_ignored_options(controller, "RMQGetMsgData", {r"\Index": index})
    found, wanted = _received(message), _kind(data, of)
    sent = found.kind
    same = sent.data_type.lower() == wanted.data_type.lower()
    if not same or (found.of is not None and found.of != _element(of)):
        raise rapid_error(
            ERR_RMQ_VALUE, f"the message is of type {sent.data_type}, not {wanted.data_type}"
        )
    if sent.dimensions != wanted.dimensions:
        raise rapid_error(
            ERR_RMQ_DIM, f"the message is {sent.spelled}, and the data are {wanted.spelled}"
        )
    value = found.value
    if value is None:
        value = parsed_value(found.text, of, _value_of(data))
    if value is None:
        raise rapid_error(ERR_RMQ_INVMSG, f"`{found.text}` is no {wanted.data_type}")
    if isinstance(data, list):
        data[:] = _copy(value)
    else:
        data.value = value


def rmq_empty_queue(controller: Messages) -> None:
    """Discard all messages."""
    controller.empty_queue()


def i_rmq_message(
    controller: Controller,
    interrupt_data_type: Ref[AnyType],
    interrupt: Var[IntNum],
    *,
    of: ArgumentType = NUM,
) -> None:
    """Order an interrupt at each message of the type and the dimensions of some data."""
    if controller.messages.is_synchronous:
        raise NotAllowed("IRMQMessage: the queue of this task is in synchronous mode")
    controller.messages.order_message(interrupt.value, _kind(interrupt_data_type, of))


def _require(controller: Controller, name: str, *, synchronous: bool, in_trap: bool) -> None:
    """Stop as a controller does if the mode or the execution level is wrong."""
    mode = controller.messages.is_synchronous
    if mode is not None and mode != synchronous:
        is_mode = "synchronous" if mode else "interrupt"
        raise NotAllowed(f"{name}: the queue of this task is in {is_mode} mode")
    if controller.interrupts.in_trap != in_trap:
        where = "only in a trap" if in_trap else "not in a trap"
        raise NotAllowed(f"{name} can be used {where}")


def _message(
    controller: Messages, data: Annotated[Any, "data"], of: Type, user_def: float | None
) -> Message:
    element = _element(of)
    if not _has_value(element):
        raise NotAllowed(f"data of type {element.name} cannot be sent: they have no value")
    count = element_count(_value_of(data))
    if count > MOST_BYTES:
        raise rapid_error(
            ERR_RMQ_MSGSIZE, f"{count} elements are more than a message of {MOST_BYTES} bytes holds"
        )
    value = _copy(_value_of(data))
    number = NO_USER_DEF if user_def is None else user_def
    text = value_text(value, of)
    return Message(_kind(data, of), text, controller.queue, number, value, element)


def _kind(data: Annotated[Any, "data"], of: Type) -> MessageKind:
    dimensions: list[int] = []
    value = _value_of(data)
    while isinstance(value, list):
        dimensions.append(len(value))
        value = value[0] if value else None
    return MessageKind(_element(of).name, tuple(dimensions))


def _element(of: Type) -> Atomic | Record:
    """Element type behind aliases and array dimensions."""
    found = resolved(of)
    return _element(found.element) if isinstance(found, ArrayOf) else found


def _has_value(of: Type) -> bool:
    found = _element(of)
    if isinstance(found, Record):
        return all(_has_value(component.type) for component in found.components)
    return found.kind is Kind.VALUE


def _value_of(data: Any) -> Any:
    """Value that a reference refers to; an array is its own value, unless it is a constant."""
    return data if isinstance(data, list) else data.value


def _copy(value: Any) -> Any:
    """Copy of a value that shares no mutable data."""
    return [_copy(one) for one in value] if isinstance(value, list) else value


def _connected(slot: Reference[Any]) -> Slot:
    found: Slot | None = slot.value
    if found is None:
        raise rapid_error(ERR_RMQ_INVALID, "the slot is not connected; RMQFindSlot connects it")
    return found


def _received(message: Reference[Any]) -> Message:
    found: Message | None = message.value
    if found is None:
        raise rapid_error(ERR_RMQ_INVMSG, "the rmqmessage holds no message")
    return found


def _limit(seconds: float | None) -> float | None:
    if seconds is None:
        return DEFAULT_TIME_S
    return None if seconds >= WAIT_FOR_EVER_S else seconds


def _out_of_time(subject: str, seconds: float | None) -> Exception:
    limit = DEFAULT_TIME_S if seconds is None else seconds
    return rapid_error(ERR_RMQ_TIMEOUT, f"{subject} came within {limit:g} s")


MESSAGES = table(
    routine("IRMQMessage", i_rmq_message),
    routine("RMQEmptyQueue", rmq_empty_queue),
    routine("RMQFindSlot", rmq_find_slot),
    routine("RMQGetMessage", rmq_get_message),
    routine("RMQGetMsgData", rmq_get_msg_data, r"Message Data \Index"),
    routine("RMQGetMsgHeader", rmq_get_msg_header, r"Message \Header \SenderId \UserDef"),
    routine("RMQGetSlotName", rmq_get_slot_name),
    routine("RMQReadWait", rmq_read_wait, r"Message \TimeOut", does=Trait.GIVE_UP),
    routine("RMQSendMessage", rmq_send_message, r"Slot SendData \UserDef"),
    routine(
        "RMQSendWait",
        rmq_send_wait,
        r"Slot SendData \UserDef Message ReceiveDataType \Timeout",
        does=Trait.GIVE_UP,
    ),
)
