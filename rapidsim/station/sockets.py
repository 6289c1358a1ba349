r"""The tables [[socket]]: the peers of the program's sockets. A camera that answers:

[[socket]]
accept = 5000
repeat = true
steps = [{ expect = "TRIG", after = 0.2, send = "12.5,3.0,90\r\n" }]

With `connect = 5000` in place of `accept` the peer is a client of the program's server. With
`udp = true` it exchanges datagrams: one for each `send` of a step.
"""

from __future__ import annotations

import re
from typing import Annotated, TypeAlias

from rapidsim.controller.cell.socket_scripts import SocketScript, SocketStep
from rapidsim.json_records.declarations import Excludes, NotNegative
from rapidsim.station.declared_tables import ReadBy, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_PORT = re.compile("[0-9]{1,5}")
_LARGEST_PORT = 65535


def _peer(reader: Reader, table: Table, path: str, key: str) -> tuple[str, int] | None:
    """Read address and port: `5000`, or `"192.168.125.5:5000"`."""
    value = table[key]
    address, _, digits = value.rpartition(":") if isinstance(value, str) else ("", "", str(value))
    # At most five ASCII digits: int() fails on superscripts and on thousands of digits.
    if not _PORT.fullmatch(digits) or not 1 <= int(digits) <= _LARGEST_PORT:
        example = 'a port is needed, as in 5000 or "192.168.125.5:5000"'
        reader.wrong(f"{path}.{key}", f"{example}; ports are 1 to {_LARGEST_PORT}")
        return None
    return address, int(digits)


def _steps(reader: Reader, table: Table, path: str, key: str) -> tuple[SocketStep, ...]:
    steps = []
    for place, step in reader.tables(table, key):
        here = f"{path}.{place}"
        found = values_of(reader, SocketStep, step, here)
        if not step:
            reader.wrong(here, 'give what happens, as in { expect = "GET", send = "12" }')
        steps.append(SocketStep(**found))
    return tuple(steps)


_Peer: TypeAlias = Annotated[tuple[str, int] | None, ReadBy(_peer)]
_ONLY_CLIENTS = Excludes("accept", "only for peers that `connect`")


@value_class(frozen=True, slots=True)
class PeerTable:
    """A table [[socket]]: a peer of the program's sockets."""

    accept: _Peer = None
    """Address and port of a server that the program connects to."""
    connect: _Peer = None
    """Address and port of the program's server that the peer connects to."""
    udp: bool = False
    """Whether it sends and receives datagrams instead of streams."""
    after: Annotated[NotNegative, _ONLY_CLIENTS] = 0.0
    """The time [s] from the program's listening to the connection."""
    steps: Annotated[tuple[SocketStep, ...], ReadBy(_steps)] = ()
    """Exchange with the program."""
    repeat: bool = False
    """Whether the steps repeat after the last one."""
    reconnect: Annotated[bool, _ONLY_CLIENTS] = False
    """Whether it connects again when its connection has ended."""


def read_sockets(reader: Reader, tables: Table) -> tuple[SocketScript, ...]:
    """Read the list; errors are collected in the reader."""
    scripts = []
    for path, table in reader.tables(tables, "socket"):
        peer = PeerTable(**values_of(reader, PeerTable, table, path))
        if ("accept" in table) == ("connect" in table):
            reader.wrong(path, "give either `accept` for a server or `connect` for a client")
        if peer.udp and "reconnect" in table:
            reader.wrong(f"{path}.reconnect", "datagrams need no connection")
        if peer.udp and any(step.close for step in peer.steps):
            reader.wrong(f"{path}.steps", "no connection can be closed: `udp` has none")
        if peer.repeat and not any(step.expect or step.after_s for step in peer.steps):
            reader.wrong(f"{path}.repeat", "a step must `expect` something or wait with `after`")
        address, port = peer.accept or peer.connect or ("", 0)
        scripts.append(
            SocketScript(
                port=port,
                steps=peer.steps,
                serves="accept" in table,
                is_datagrams=peer.udp,
                address=address,
                after_s=peer.after,
                repeats=peer.repeat,
                reconnects=peer.reconnect,
            )
        )
    return tuple(scripts)
