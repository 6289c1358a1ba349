"""Message queues of clients: created and read here, and also written to by programs."""

from __future__ import annotations

import re
from typing import Final

from rapidsim.controller.cell.message_queues import MOST_MESSAGES
from rapidsim.language.error_numbers import ERR_RMQ_INVALID
from rapidsim.language.errors import RapidError
from rapidsim.language.messages import NO_USER_DEF, Message, MessageKind
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, count, number, required_value
from rapidsim.simulation.live.messages import kind_of

COMMAND: Final = "111"
KIND: Final = "1"
_TYPE: Final = re.compile(r"\s*([A-Za-z]\w{0,31})\s*;(.*)", re.DOTALL)
_MOST_QUEUES: Final = 50
"""Largest number of queues of one session."""
_MOST_MESSAGES: Final = 10_000


def queues(context: RequestContext, request: Request) -> Answer:
    """The queues of all clients: others may send to them."""
    del request
    items = (
        Item("dipc-queue-li", name, {"dipc-queue-name": name}, href=f"rw/dipc/{name}")
        for name in context.queues
    )
    return Answer(resources=tuple(items))


def create(context: RequestContext, request: Request) -> Answer:
    """Create a queue for a client.

    Raises:
        RefusedRequest: If it exists, or there are too many.
    """
    name = required_value(request.form, "dipc-queue-name")
    there = context.live.cell.messages.find(name) is not None
    count_of_client = list(context.owners.values()).count(request.session)
    if there or not name or count_of_client >= _MOST_QUEUES:
        raise refused(BAD_PARAMETER, f"the queue {name} is there already, or there are too many")
    most = min(max(1, count(request.form, "dipc-queue-size", MOST_MESSAGES)), _MOST_MESSAGES)
    context.queues[name] = context.live.cell.messages.connect(name, most)
    context.owners[name] = request.session
    return Answer(status=201)


def send(context: RequestContext, request: Request, queue: str) -> Answer:
    """Put a message into the queue of a task, or of a client.

    Raises:
        RefusedRequest: If there is no such queue, or it does not accept the message.
    """
    form, live = request.form, context.live
    messages = live.cell.messages
    found = messages.find(queue, is_external=True)
    found = found or messages.find(f"RMQ_{queue}", is_external=True)
    if found is None:
        raise refused(NOT_FOUND, f"there is no queue {queue}")
    data = required_value(form, "dipc-data")
    user = number(form, "dipc-userdef") if "dipc-userdef" in form else NO_USER_DEF
    sender = context.queue_of(form.get("dipc-src-queue-name", ""), request.session)
    if found.name in context.queues:
        message = Message(MessageKind(""), data, sender, user)
    elif (matched := _TYPE.fullmatch(data)) is not None:
        text = matched[2].strip()
        message = Message(kind_of(matched[1], text, live.tasks.values()), text, sender, user)
    else:
        raise refused(BAD_PARAMETER, "`dipc-data` for a task is a type and a value: `num;5`")
    try:
        found.put(message, live.now_s)
    except RapidError as error:
        why = NOT_FOUND if error.errno == ERR_RMQ_INVALID else BAD_PARAMETER
        raise refused(why, error.message) from None
    live.wake_programs()
    return DONE


def read(context: RequestContext, request: Request, queue: str) -> Answer:
    """The messages waiting for a client, which are removed.

    Raises:
        RefusedRequest: If the client has no such queue.
    """
    found = context.queue_of(queue, request.session)
    if found is None:
        raise refused(NOT_FOUND, f"the client has no queue {queue}")
    # RobotWare 6 returns all of them at once, RobotWare 7 one.
    count = len(found.messages) if request.generation == 1 else 1
    kind = "dipc-read-li" if request.generation == 1 else "dipc-read"
    waiting = found.messages[:count]
    del found.messages[:count]
    return Answer(tuple(message_item(queue, one, kind) for one in waiting))


def queue(context: RequestContext, request: Request, queue: str) -> Answer:
    """A queue of a client.

    Raises:
        RefusedRequest: If the client has no such queue.
    """
    if context.queue_of(queue, request.session) is None:
        raise refused(NOT_FOUND, f"the client has no queue {queue}")
    return Answer((Item("dipc-queue-li", queue, {"dipc-queue-name": queue}),))


def message_item(queue: str, message: Message, kind: str) -> Item:
    """Return a message as clients see it; a public client reads the data before the user value."""
    user = "" if message.user_def == NO_USER_DEF else f"{message.user_def:g}"
    fields = {
        "dipc-slotid": "" if message.sender is None else message.sender.name,
        "dipc-data": message.wire,
        "dipc-userdef": user or "0",
        "dipc-msgtype": KIND,
        "dipc-cmd": COMMAND,
        "queue-name": queue,
    }
    return Item(kind, queue, fields, href=f"/rw/dipc/{queue}")
