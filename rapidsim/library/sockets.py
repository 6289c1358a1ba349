r"""Sockets: communication with another computer over TCP, or over UDP in datagrams.

The controller provides the peer: a script of the station, another task, or the network if the run
permits it. Text is bytes in ISO 8859-1. Waits end after 60 s by default or after \Time; WAIT_MAX
waits indefinitely.

Unverified: a datagram longer than its destination loses the rest, and stream instructions on a
datagram socket, and vice versa, raise ERR_SOCK_UNSPEC.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SocketCreate",
"SocketReceive" and their like; Application manual Controller software, "Socket Messaging".
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated

from rapidsim.language.annotations import (
    Byte,
    InOut,
    Num,
    ParameterMode,
    RawBytes,
    SocketDev,
    SocketStatus,
    String,
    Switch,
    Var,
)
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_SOCK_ADDR_INVALID,
    ERR_SOCK_CLOSED,
    ERR_SOCK_IS_BOUND,
    ERR_SOCK_IS_CONN,
    ERR_SOCK_NOT_BOUND,
    ERR_SOCK_NOT_CONN,
    ERR_SOCK_TIMEOUT,
    ERR_SOCK_UNSPEC,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.language.sockets import (
    BOUND,
    CLOSED,
    CONNECTED,
    LISTENING,
    Connection,
    DatagramPort,
    Sockets,
    SocketState,
)
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.library.raw_bytes import MOST_BYTES
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

DEFAULT_TIME_S = 60.0
WAIT_FOR_EVER_S = 8388608.0
r"""The constant WAIT_MAX: as \Time, it disables the time limit of a wait."""
_ENCODING = "iso-8859-1"
_LARGEST_PORT = 65535

_Device = Reference[SocketState | None]


def socket_create(controller: Sockets, socket: Var[SocketDev], *, udp: Switch = False) -> None:
    r"""Create a stream socket (TCP) or, with \UDP, a datagram socket."""
    if socket.value is not None:
        raise rapid_error(ERR_SOCK_IS_CONN, "the socket is there already; SocketClose it first")
    socket.value = SocketState(datagrams=controller.open_datagrams() if udp else None)


def socket_bind(
    controller: Sockets, socket: Var[SocketDev], local_address: String, local_port: Num
) -> None:
    """Bind a socket to an address and a port of the controller."""
    state = _created(socket)
    if state.port:
        raise rapid_error(ERR_SOCK_IS_BOUND, f"the socket is bound to port {state.port} already")
    if state.datagrams is not None:
        host, port = _host(local_address), _port(local_port)
        controller.bind_datagrams(state.datagrams, host, port)
        socket.value = replace(state, status=BOUND, address=local_address, port=port)
        return
    listener = controller.bind_port(_host(local_address), _port(local_port))
    socket.value = replace(
        state, status=BOUND, address=local_address, port=listener.port, listener=listener
    )


def socket_listen(controller: Sockets, socket: Var[SocketDev]) -> None:
    """Accept connections of clients to the port of a socket."""
    state = _stream_socket(socket, "SocketListen")
    if state.listener is None:
        raise rapid_error(ERR_SOCK_NOT_BOUND, "the socket has no port; SocketBind gives it one")
    if state.status != LISTENING:
        controller.open_port(state.listener)
        socket.value = replace(state, status=LISTENING)


def socket_accept(
    controller: Sockets,
    socket: Var[SocketDev],
    client_socket: Var[SocketDev],
    *,
    client_address: Var[String] | None = None,
    time: Num | None = None,
) -> None:
    """Wait for a client; `ClientSocket` is the connection to it."""
    state = _stream_socket(socket, "SocketAccept")
    if state.listener is None or state.status != LISTENING:
        raise rapid_error(
            ERR_SOCK_NOT_BOUND, "the socket does not listen; SocketListen comes first"
        )
    if client_socket.value is not None:
        raise rapid_error(
            ERR_SOCK_IS_CONN, "the socket for the client is in use; SocketClose it first"
        )
    connection = controller.accept_client(state.listener, max_time=_limit(time))
    if connection is None:
        raise _too_late(f"no client has connected to port {state.port}", time)
    client_socket.value = SocketState(CONNECTED, connection=connection)
    if client_address is not None:
        client_address.value = connection.peer.partition(":")[0]


def socket_connect(
    controller: Sockets,
    socket: Var[SocketDev],
    address: String,
    port: Num,
    *,
    time: Num | None = None,
) -> None:
    """Connect to a server."""
    state = _stream_socket(socket, "SocketConnect")
    if state.connection is not None:
        raise rapid_error(
            ERR_SOCK_IS_CONN, f"the socket is connected to {state.connection.peer} already"
        )
    if not address:
        raise rapid_error(ERR_SOCK_ADDR_INVALID, "the address to connect to is empty")
    if state.status == LISTENING:
        raise rapid_error(ERR_SOCK_UNSPEC, f"the socket listens on port {state.port}")
    connection = controller.connect_socket(_host(address), _port(port), max_time=_limit(time))
    if connection is None:
        raise _too_late(f"nothing listens at {address}:{port:g}", time)
    socket.value = replace(state, status=CONNECTED, connection=connection)


def socket_send(
    controller: Sockets,
    socket: Var[SocketDev],
    *,
    str_: String | None = None,
    raw_data: Var[RawBytes] | None = None,
    data: list[Byte] | None = None,
    no_of_bytes: Num | None = None,
) -> None:
    """Send a text, raw bytes or an array of bytes, completely or the first bytes only."""
    connection = _connected(socket)
    given = _bytes_to_send("SocketSend", str_, raw_data, data, no_of_bytes)
    controller.send_bytes(connection, given)


def _bytes_to_send(
    name: str,
    str_: str | None,
    raw_data: Reference[bytes] | None,
    data: list[float] | None,
    no_of_bytes: float | None,
) -> bytes:
    """Bytes that an instruction sends."""
    if str_ is not None:
        given = str_.encode(_ENCODING, "replace")
    elif raw_data is not None:
        given = raw_data.value
    elif data is not None:
        given = bytes(_byte(value) for value in data)
    else:
        raise rapid_error(ERR_ARGVALERR, rf"{name} needs \Str, \RawData or \Data")
    count = len(given) if no_of_bytes is None else int(no_of_bytes)
    if not 0 <= count <= len(given):
        raise rapid_error(ERR_ARGVALERR, f"{count} bytes are to be sent of {len(given)}")
    return given[:count]


def socket_receive(
    controller: Sockets,
    socket: Var[SocketDev],
    *,
    str_: InOut[String] | None = None,
    raw_data: Var[RawBytes] | None = None,
    data: Annotated[list[Byte], ParameterMode.VAR] | None = None,
    read_no_of_bytes: Num | None = None,
    no_rec_bytes: Var[Num] | None = None,
    time: Num | None = None,
) -> None:
    """Wait for bytes: for any, or for an exact number."""
    connection = _connected(socket)
    most = MAX_STRING if str_ is not None else MOST_BYTES if data is None else len(data)
    wanted = 1
    if read_no_of_bytes is not None:
        wanted = most = _count(read_no_of_bytes, most)
    in_time = controller.await_bytes(connection, wanted, max_time=_limit(time))
    if len(connection.received) < wanted:
        if in_time:
            raise rapid_error(ERR_SOCK_CLOSED, f"{connection.peer} has closed the connection")
        there = len(connection.received)
        got = f"{there} of {wanted} bytes" if there else "nothing"
        raise _too_late(f"{got} came from {connection.peer}", time)
    received = bytes(connection.received[:most])
    del connection.received[:most]
    _store("SocketReceive", received, str_, raw_data, data)
    if no_rec_bytes is not None:
        no_rec_bytes.value = float(len(received))


def _store(
    name: str,
    received: bytes,
    str_: Reference[str] | None,
    raw_data: Reference[bytes] | None,
    data: list[float] | None,
) -> None:
    """Store received bytes in the argument of a program."""
    if str_ is not None:
        str_.value = received.decode(_ENCODING)
    elif raw_data is not None:
        raw_data.value = received
    elif data is not None:
        data[: len(received)] = [float(byte) for byte in received]
    else:
        raise rapid_error(ERR_ARGVALERR, rf"{name} needs \Str, \RawData or \Data")


def socket_peek(controller: Sockets, socket: Var[SocketDev]) -> Num:
    """The number of bytes that can be received without waiting."""
    connection = _connected(socket)
    controller.await_bytes(connection, 1, max_time=0.0)
    return float(len(connection.received))


def socket_send_to(
    controller: Sockets,
    socket: Var[SocketDev],
    remote_address: String,
    remote_port: Num,
    *,
    str_: String | None = None,
    raw_data: Var[RawBytes] | None = None,
    data: list[Byte] | None = None,
    no_of_bytes: Num | None = None,
) -> None:
    """Send a datagram; an unbound socket is bound to a free port."""
    port = _datagram_port(socket, "SocketSendTo")
    given = _bytes_to_send("SocketSendTo", str_, raw_data, data, no_of_bytes)
    if not remote_address:
        raise rapid_error(ERR_SOCK_ADDR_INVALID, "the address to send to is empty")
    controller.send_datagram(port, _host(remote_address), _port(remote_port), given)


def socket_receive_from(
    controller: Sockets,
    socket: Var[SocketDev],
    remote_address: Var[String],
    remote_port: Var[Num],
    *,
    str_: Var[String] | None = None,
    raw_data: Var[RawBytes] | None = None,
    data: Annotated[list[Byte], ParameterMode.VAR] | None = None,
    no_rec_bytes: Var[Num] | None = None,
    time: Num | None = None,
) -> None:
    """Wait for a datagram, and store its sender."""
    port = _datagram_port(socket, "SocketReceiveFrom")
    most = MAX_STRING if str_ is not None else MOST_BYTES if data is None else len(data)
    datagram = controller.await_datagram(port, max_time=_limit(time))
    if datagram is None:
        raise _too_late("no datagram came", time)
    received = datagram.data[:most]
    _store("SocketReceiveFrom", received, str_, raw_data, data)
    remote_address.value, remote_port.value = datagram.address, float(datagram.port)
    if no_rec_bytes is not None:
        no_rec_bytes.value = float(len(received))


def socket_close(controller: Sockets, socket: Var[SocketDev]) -> None:
    """End a connection or stop listening; a closed socket is no error."""
    state = socket.value
    if state is None:
        return
    socket.value = None
    if state.datagrams is not None:
        controller.close_datagrams(state.datagrams)
    else:
        controller.close_socket(state.listener, state.connection)


def socket_get_status(socket: Var[SocketDev]) -> SocketStatus:
    """The status of a socket: SOCKET_CREATED, SOCKET_CONNECTED and so on."""
    return CLOSED if socket.value is None else socket.value.status


def _created(socket: _Device) -> SocketState:
    if socket.value is None:
        raise rapid_error(ERR_SOCK_CLOSED, "the socket is closed; SocketCreate makes it")
    return socket.value


def _stream_socket(socket: _Device, name: str) -> SocketState:
    state = _created(socket)
    if state.datagrams is not None:
        raise rapid_error(
            ERR_SOCK_UNSPEC, rf"the socket was created with \UDP, and {name} needs one without"
        )
    return state


def _datagram_port(socket: _Device, name: str) -> DatagramPort:
    port = _created(socket).datagrams
    if port is None:
        raise rapid_error(
            ERR_SOCK_UNSPEC, rf"the socket was created without \UDP, and {name} needs one with it"
        )
    return port


def _connected(socket: _Device) -> Connection:
    connection = _created(socket).connection
    if connection is None:
        raise rapid_error(ERR_SOCK_NOT_CONN, "the socket is not connected")
    return connection


def _limit(time: float | None) -> float | None:
    """Time limit [s] of a wait; None without a limit."""
    seconds = DEFAULT_TIME_S if time is None else time
    return None if seconds >= WAIT_FOR_EVER_S else max(0.0, seconds)


def _too_late(subject: str, time: float | None) -> Exception:
    return rapid_error(ERR_SOCK_TIMEOUT, f"{subject} within {_limit(time) or 0.0:g} s")


def _port(value: float) -> int:
    if not (1 <= value <= _LARGEST_PORT and value == math.floor(value)):
        raise rapid_error(
            ERR_SOCK_ADDR_INVALID, f"there is no port {value:.7g}; ports are 1..{_LARGEST_PORT}"
        )
    return int(value)


def _host(address: str) -> str:
    """Check an address as controllers do: four numbers, no host name; empty for any own address."""
    numbers = address.split(".")
    if address in ("", "localhost") or (
        len(numbers) == 4 and all(one.isdecimal() and int(one) <= 255 for one in numbers)
    ):
        return address
    raise rapid_error(
        ERR_SOCK_ADDR_INVALID, f'"{address}" is no address; one is made of four numbers, 0..255'
    )


def _count(value: float, most: int) -> int:
    if not (1 <= value <= most and value == math.floor(value)):
        raise rapid_error(
            ERR_ARGVALERR, f"{value:.7g} bytes cannot be received at once; 1..{most} can"
        )
    return int(value)


def _byte(value: float) -> int:
    if not (0 <= value <= 255 and value == math.floor(value)):
        raise rapid_error(ERR_ARGVALERR, f"{value:.7g} is not a byte; bytes are 0..255")
    return int(value)


_DATA = r"\Str|\RawData|\Data"

SOCKETS = table(
    routine("SocketCreate", socket_create, r"Socket \UDP"),
    routine("SocketBind", socket_bind),
    routine("SocketListen", socket_listen),
    routine("SocketAccept", socket_accept, does=Trait.WAIT),
    routine("SocketConnect", socket_connect, does=Trait.WAIT),
    routine("SocketSend", socket_send, rf"Socket {_DATA} \NoOfBytes"),
    routine(
        "SocketReceive",
        socket_receive,
        rf"Socket {_DATA} \ReadNoOfBytes \NoRecBytes \Time",
        does=Trait.WAIT,
    ),
    routine("SocketPeek", socket_peek),
    routine(
        "SocketSendTo",
        socket_send_to,
        rf"Socket RemoteAddress RemotePort {_DATA} \NoOfBytes",
    ),
    routine(
        "SocketReceiveFrom",
        socket_receive_from,
        rf"Socket {_DATA} \NoRecBytes RemoteAddress RemotePort \Time",
        does=Trait.WAIT,
    ),
    routine("SocketClose", socket_close),
    routine("SocketGetStatus", socket_get_status),
)
