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

from rapidsim.controller.cell.socket_scripts import SocketScript, SocketStep
from rapidsim.station.declared_tables import values_of
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("accept", "connect", "udp", "after", "steps", "repeat", "reconnect")
_PORT = re.compile("[0-9]{1,5}")
_LARGEST_PORT = 65535


def read_sockets(reader: Reader, tables: Table) -> tuple[SocketScript, ...]:
    """Read the list; errors are collected in the reader."""
    scripts = []
    for path, table in reader.tables(tables, "socket"):
        reader.note_unknown_keys(path, table, _KEYS)
        if ("accept" in table) == ("connect" in table):
            reader.wrong(path, "give either `accept` for a server or `connect` for a client")
            continue
        serves = "accept" in table
        address, port = _place(reader, table, path, "accept" if serves else "connect")
        if serves:
            for key in ("after", "reconnect"):
                if key in table:
                    reader.wrong(f"{path}.{key}", "only for peers that `connect`")
        steps = _steps(reader, path, table)
        is_datagrams = reader.flag(table, path, "udp")
        if is_datagrams:
            if "reconnect" in table:
                reader.wrong(f"{path}.reconnect", "datagrams need no connection")
            if any(step.close for step in steps):
                reader.wrong(f"{path}.steps", "no connection can be closed: `udp` has none")
        repeats = reader.flag(table, path, "repeat")
        if repeats and not any(step.expect or step.after_s for step in steps):
            reader.wrong(f"{path}.repeat", "a step must `expect` something or wait with `after`")
        scripts.append(
            SocketScript(
                port=port,
                steps=steps,
                serves=serves,
                is_datagrams=is_datagrams,
                address=address,
                after_s=reader.not_negative(table, path, "after") or 0.0,
                repeats=repeats,
                reconnects=reader.flag(table, path, "reconnect"),
            )
        )
    return tuple(scripts)


def _place(reader: Reader, table: Table, path: str, key: str) -> tuple[str, int]:
    """Read address and port: `5000`, or `"192.168.125.5:5000"`."""
    value = table[key]
    address, _, digits = value.rpartition(":") if isinstance(value, str) else ("", "", str(value))
    # At most five ASCII digits: int() fails on superscripts and on thousands of digits.
    if not _PORT.fullmatch(digits) or not 1 <= int(digits) <= _LARGEST_PORT:
        example = 'a port is needed, as in 5000 or "192.168.125.5:5000"'
        reader.wrong(f"{path}.{key}", f"{example}; ports are 1 to {_LARGEST_PORT}")
        return "", 0
    return address, int(digits)


def _steps(reader: Reader, path: str, table: Table) -> tuple[SocketStep, ...]:
    steps = []
    for place, step in reader.tables(table, "steps"):
        here = f"{path}.{place}"
        found = values_of(reader, SocketStep, step, here)
        if not step:
            reader.wrong(here, 'give what happens, as in { expect = "GET", send = "12" }')
        steps.append(SocketStep(**found))
    return tuple(steps)
