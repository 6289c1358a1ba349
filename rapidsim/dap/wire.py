"""Messages of the Debug Adapter Protocol: JSON objects, each after a header with its length."""

from __future__ import annotations

import json
from typing import IO, Any, TypeAlias

Message: TypeAlias = dict[str, Any]

_LARGEST = 50_000_000
"""[bytes]; a header may promise anything."""


class WireError(Exception):
    """Bytes that are no message; the message has the reason."""


def read_message(stream: IO[bytes]) -> Message | None:
    """Read one message; None at the end of the stream.

    Raises:
        WireError: If the bytes are no message.
    """
    length: int | None = None
    while (line := stream.readline(1000)) not in (b"\r\n", b"\n"):
        if not line:
            return None
        name, _, value = line.decode("ascii", "replace").partition(":")
        if name.strip().lower() == "content-length":
            if not value.strip().isdecimal() or int(value) > _LARGEST:
                raise WireError(f"a message cannot have the length {value.strip()!r}")
            length = int(value)
    if length is None:
        raise WireError("a header has no Content-Length")
    data = stream.read(length)
    if len(data) < length:
        return None
    try:
        message = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise WireError(f"a message is no JSON: {error}") from None
    if not isinstance(message, dict):
        raise WireError("a message is no JSON object")
    return message


def write_message(stream: IO[bytes], message: Message) -> None:
    """Write one message."""
    data = json.dumps(message, ensure_ascii=False).encode()
    stream.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
    stream.flush()
