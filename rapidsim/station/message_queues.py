"""The key `rmq` of [[task]]: message queue of the task."""

from __future__ import annotations

from rapidsim.controller.cell.message_queues import (
    LEAST_BYTES,
    MOST_BYTES,
    MOST_MESSAGES,
    QueueMode,
    QueueSettings,
    QueueType,
)
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("type", "mode", "size", "messages")
_AS_DELIVERED = QueueSettings()


def read_queue(
    reader: Reader, path: str, task: Table, default: QueueSettings | None = None
) -> QueueSettings | None:
    """Read the queue of a [[task]], completed from that of a backup; None without either.

    Errors are collected in the reader.
    """
    if "rmq" not in task:
        return default
    usual = default or _AS_DELIVERED
    path = f"{path}.rmq"
    described = reader.table(task, "rmq", path)
    reader.note_unknown_keys(path, described, _KEYS)
    kind = reader.text(described, path, "type") or usual.type.value
    mode = reader.text(described, path, "mode")
    if kind.lower() not in [one.value for one in QueueType]:
        reader.wrong(f"{path}.type", f"`{kind}` is not a type", "known: none, internal, remote")
        kind = usual.type.value
    if mode is not None and mode.lower() not in [one.value for one in QueueMode]:
        reader.wrong(f"{path}.mode", f"`{mode}` is not a mode", "known: interrupt, synchronous")
        mode = None
    return QueueSettings(
        QueueType(kind.lower()),
        usual.mode if mode is None else QueueMode(mode.lower()),
        _whole(reader, described, path, "size", LEAST_BYTES, MOST_BYTES, usual.max_bytes),
        _whole(reader, described, path, "messages", 1, MOST_MESSAGES, usual.max_messages),
    )


def _whole(
    reader: Reader, table: Table, path: str, key: str, least: int, most: int, default: int
) -> int:
    number = reader.number(table, path, key)
    if number is None:
        return default
    if not (least <= number <= most and number == int(number)):
        reader.wrong(f"{path}.{key}", f"a whole number from {least} to {most} is needed")
        return default
    return int(number)
