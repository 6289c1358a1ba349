"""Sockets of one task: their peers, and waiting for them in virtual time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.datagrams import Mailbox
from rapidsim.controller.cell.network import NetworkConnection, NetworkMailbox, NetworkPort
from rapidsim.controller.cell.streams import Port, StreamEnd
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import MAX_TIME, EventKind
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.findings.runs import NobodyAnswers, NobodyConnects
from rapidsim.language.error_numbers import ERR_SOCK_CLOSED, rapid_error
from rapidsim.language.sockets import Connection, Datagram, DatagramPort, Listener
from rapidsim.values import value_class

_CURE = (
    "a [[socket]] of rapidsim.toml plays the other end, `--allow-network` lets a real one in, "
    r"\Time ends the wait"
)
_STEP_S = 0.01
"""Time [s] for which a task waits for the network before other tasks may send."""
_SHOWN = 40
"""Number of characters of sent and received data that an event shows."""


@value_class(frozen=True, slots=True)
class TaskSockets:
    """Implements `language.sockets.Sockets`."""

    clock: TaskClock
    cell: Cell
    journal: Journal
    _opened: list[Port | StreamEnd] = field(default_factory=list)
    _mailboxes: dict[Mailbox, NetworkMailbox | None] = field(default_factory=dict)
    """The sockets for datagrams, each with its real one if the run may use the network."""

    def bind_port(self, address: str, port: int) -> Listener:
        """Bind a port: of the network if the run may use it.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        self.clock.synchronise()
        network, sockets = self.cell.network, self.cell.sockets
        if network is not None and not sockets.is_scripted(port, serves=False):
            return network.bind(address, port)
        bound = sockets.bind(port, address)
        self._opened.append(bound)
        return bound

    def open_port(self, listener: Listener) -> None:
        """Let clients connect to a port.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        now_s = self.clock.synchronise()
        if isinstance(listener, NetworkPort):
            listener.listen()
        else:
            assert isinstance(listener, Port)
            self.cell.sockets.listen(listener, now_s)
        port = listener.port
        self.clock.event(EventKind.SOCKET, f"listens on port {port}", port=port)
        self.clock.notify_tasks()

    def accept_client(self, listener: Listener, *, max_time: float | None) -> Connection | None:
        """Wait for a client; None if no client connects in time.

        Raises:
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        deadline_s = self._deadline(max_time)
        found: Connection | None = None
        if isinstance(listener, NetworkPort):
            found = listener.accept(self._patience(deadline_s))
            self._after_network(found is not None, deadline_s)
        else:
            assert isinstance(listener, Port)
            waiting = listener.waiting
            nobody = (
                f"`SocketAccept` waits for a client at port {listener.port}, and none comes: "
                "no [[socket]] of the station file connects to it"
            )
            if self._waited(lambda: bool(waiting), deadline_s, nobody):
                found = waiting.pop(0)
                self._opened.append(found)
            elif self.cell.sockets.external is None and not self.cell.sockets.is_scripted(
                listener.port, serves=False
            ):
                told = NobodyConnects(listener.port)
                self.journal.finding(told, self.clock.place, once=told)
        if found is not None:
            self.clock.event(EventKind.SOCKET, f"accepted {found.peer}", peer=found.peer)
        return found

    def connect_socket(
        self, address: str, port: int, *, max_time: float | None
    ) -> Connection | None:
        """Connect to a server; None if no server answers in time.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH if the run may not contact the host.
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        deadline_s = self._deadline(max_time)
        network, sockets = self.cell.network, self.cell.sockets
        found: Connection | None = None
        if network is not None and not sockets.is_scripted(port, serves=True):
            found = network.connect(address, port, self._patience(deadline_s))
            self._after_network(found is not None, deadline_s)
        else:
            ends: list[StreamEnd] = []

            def is_answered() -> bool:
                end = sockets.connect(address, port, self.clock.resolve_time())
                ends.extend([end] if end is not None else [])
                return end is not None

            nobody = f"`SocketConnect` waits for {address}:{port}, and nothing listens there"
            if self._waited(is_answered, deadline_s, nobody):
                found = ends[0]
                self._opened.append(found)
                self.clock.notify_tasks()
            elif sockets.external is not None:
                sockets.hang_up(address, port, self.clock.resolve_time())
            elif network is None:
                self.journal.finding(NobodyAnswers(f"{address}:{port}"), self.clock.place)
        if found is not None:
            self.clock.event(EventKind.SOCKET, f"connected to {found.peer}", peer=found.peer)
        return found

    def send_bytes(self, connection: Connection, data: bytes) -> None:
        """Send bytes.

        Raises:
            RapidError: ERR_SOCK_CLOSED if the other end has closed.
        """
        now_s = self.clock.synchronise()
        if connection.has_ended:
            raise rapid_error(ERR_SOCK_CLOSED, f"{connection.peer} has closed the connection")
        self.clock.event(
            EventKind.SOCKET,
            f"sent {_quote(data)} to {connection.peer}",
            peer=connection.peer,
            sent=data.decode("iso-8859-1"),
        )
        if isinstance(connection, NetworkConnection):
            sent = connection.send(data, self._patience(math.inf))
            self._after_network(sent, math.inf)
        else:
            assert isinstance(connection, StreamEnd)
            connection.send(data, now_s)
            self.clock.notify_tasks()

    def await_bytes(self, connection: Connection, count: int, *, max_time: float | None) -> bool:
        """Wait for `count` bytes or the end of the data; False if time ran out first.

        Raises:
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        deadline_s = self._deadline(max_time)

        def is_there() -> bool:
            return connection.has_ended or len(connection.received) >= count

        if isinstance(connection, NetworkConnection):
            connection.wait(count, lambda: self._patience(deadline_s))
            self._after_network(is_there(), deadline_s)
            there = is_there()
        else:
            nothing = f"`SocketReceive` waits for {connection.peer}, which sends nothing more"
            there = self._waited(is_there, deadline_s, nothing)
        if there and connection.received and max_time != 0.0:
            self.clock.event(
                EventKind.SOCKET,
                f"{_quote(bytes(connection.received))} came from {connection.peer}",
                peer=connection.peer,
                received=connection.received.decode("iso-8859-1"),
            )
        return there

    def close_socket(self, listener: Listener | None, connection: Connection | None) -> None:
        """Close the listener and the connection of a socket."""
        now_s = self.clock.synchronise()
        if isinstance(listener, Port):
            self._close_port(listener, now_s)
        elif isinstance(listener, NetworkPort):
            listener.close()
        ours = (listener, connection)
        self._opened[:] = [one for one in self._opened if not any(one is own for own in ours)]
        if isinstance(connection, StreamEnd):
            connection.close(now_s)
        elif isinstance(connection, NetworkConnection):
            connection.close()
        self.clock.notify_tasks()

    def open_datagrams(self) -> DatagramPort:
        """Open a socket for datagrams, without a port."""
        mailbox = Mailbox()
        self._mailboxes[mailbox] = None
        return mailbox

    def bind_datagrams(self, socket: DatagramPort, address: str, port: int) -> None:
        """Bind a socket for datagrams to a port: of the network, too, if the run may use it.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        assert isinstance(socket, Mailbox)
        now_s = self.clock.synchronise()
        network, table = self.cell.network, self.cell.datagrams
        table.require_free(port)
        if network is not None and not table.is_scripted(port, serves=False):
            self._mailboxes[socket] = network.open_mailbox(address, port)
        table.bind(socket, address, port, now_s)
        self.clock.event(EventKind.SOCKET, f"takes datagrams at port {port}", port=port)
        self.clock.notify_tasks()

    def send_datagram(self, socket: DatagramPort, address: str, port: int, data: bytes) -> None:
        """Send a datagram.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH if the run may not contact the host.
        """
        assert isinstance(socket, Mailbox)
        now_s, peer, network = self.clock.synchronise(), f"{address}:{port}", self.cell.network
        self.clock.event(
            EventKind.SOCKET,
            f"sent {_quote(data)} to {peer}",
            peer=peer,
            sent=data.decode("iso-8859-1"),
        )
        if self.cell.datagrams.send(socket, address, port, data, now_s):
            self.clock.notify_tasks()
        elif network is not None:
            network.require_reachable(address)
            mailbox = self._mailboxes.get(socket) or network.open_mailbox("", 0)
            self._mailboxes[socket] = mailbox
            mailbox.send(address, port, data)
            self._after_network(True, math.inf)
        else:
            cure = "a [[socket]] with `udp = true` or `--allow-network` gives it a receiver"
            self.journal.unsimulated(
                f"SocketSendTo to {peer}", f"the datagram is lost; {cure}", self.clock.place
            )

    def await_datagram(self, socket: DatagramPort, *, max_time: float | None) -> Datagram | None:
        """Wait for a datagram; None if none arrives in time.

        Raises:
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        assert isinstance(socket, Mailbox)
        deadline_s = self._deadline(max_time)
        real, received = self._mailboxes.get(socket), socket.received
        if real is None or received or socket.talks_to_script:
            where = f"at port {socket.port}" if socket.port else "without a port"
            nothing = f"`SocketReceiveFrom` waits for a datagram {where}, and none comes"
            arrived = self._waited(lambda: bool(received), deadline_s, nothing)
            datagram = received.popleft() if arrived else None
        elif self.cell.is_shared:
            datagram = self._await_network_or_task(socket, real, deadline_s)
        else:
            datagram = real.receive(self._patience(deadline_s))
            self._after_network(datagram is not None, deadline_s)
        if datagram is not None:
            peer = f"{datagram.address}:{datagram.port}"
            self.clock.event(
                EventKind.SOCKET,
                f"{_quote(datagram.data)} came from {peer}",
                peer=peer,
                received=datagram.data.decode("iso-8859-1"),
            )
        return datagram

    def _await_network_or_task(
        self, socket: Mailbox, real: NetworkMailbox, deadline_s: float
    ) -> Datagram | None:
        """Wait in steps of the same duration in virtual time and on the computer's clock."""
        instead = "a task waits as long in simulated time as on the computer's clock"
        self.journal.unsimulated("the network", instead, self.clock.place)
        with self.clock.waiting("the network") as wait:
            while self.clock.resolve_time() < deadline_s:
                datagram = socket.received.popleft() if socket.received else real.receive(_STEP_S)
                if datagram is not None:
                    wait.ended_by = "the network"
                    return datagram
                self.clock.await_event(min(deadline_s, self.clock.resolve_time() + _STEP_S))
            wait.ended_by = MAX_TIME
        return socket.received.popleft() if socket.received else real.receive(0.0)

    def close_datagrams(self, socket: DatagramPort) -> None:
        """Release the port of a socket for datagrams."""
        assert isinstance(socket, Mailbox)
        self.clock.synchronise()
        self._close_mailbox(socket)
        self.clock.notify_tasks()

    def _close_mailbox(self, mailbox: Mailbox) -> None:
        self.cell.datagrams.close(mailbox)
        real = self._mailboxes.pop(mailbox, None)
        if real is not None:
            real.close()

    def close_all(self, now_s: float) -> None:
        """Close at a time [s] the sockets that the ending program has open."""
        for mailbox in tuple(self._mailboxes):
            self._close_mailbox(mailbox)
        for one in self._opened:
            if isinstance(one, Port):
                self._close_port(one, now_s)
            elif one.is_open:
                one.close(now_s)
        self._opened.clear()

    def _close_port(self, port: Port, now_s: float) -> None:
        self.cell.sockets.close_port(port)
        if self.cell.sockets.external is not None:
            for one in port.waiting:
                one.close(now_s)

    def _deadline(self, max_time: float | None) -> float:
        self.clock.note_line()
        now_s = self.clock.synchronise()
        return math.inf if max_time is None else now_s + max_time

    def _waited(self, condition: Callable[[], bool], deadline_s: float, in_vain: str) -> bool:
        """Let time pass until a condition holds; False if the deadline [s] is earlier."""
        with self.clock.waiting("the peer of the socket") as wait:
            while not condition():
                if self.clock.resolve_time() >= deadline_s:
                    wait.ended_by = MAX_TIME
                    return False
                if not self.clock.await_event(deadline_s):
                    raise WaitsForever(in_vain, _CURE)
            wait.ended_by = "the peer of the socket"
        return True

    def _patience(self, deadline_s: float) -> float | None:
        """Maximum duration [s] of a network call; None for no limit."""
        left_s = min(deadline_s, self.cell.max_time_s) - self.clock.resolve_time()
        left_s = min(left_s, self.cell.watchdog.left_s)
        return None if math.isinf(left_s) else max(0.0, left_s)

    def _after_network(self, in_time: bool, deadline_s: float) -> None:
        """Pass the time of a wait without an answer; an answer takes no virtual time."""
        self.journal.unsimulated("the network", "answers take no simulated time", self.clock.place)
        self.cell.watchdog.check()
        if not in_time:
            with self.clock.waiting("the network") as wait:
                self.clock.pass_time(max(deadline_s, self.clock.resolve_time()))
                wait.ended_by = MAX_TIME


def _quote(data: bytes) -> str:
    """Bytes as text in quotes, control characters by their codes, as RAPID writes them."""
    text = "".join(
        character if character.isprintable() else f"\\{ord(character):02X}"
        for character in data.decode("iso-8859-1")
    )
    return f'"{text}"' if len(text) <= _SHOWN else f'"{text[:_SHOWN]}..." ({len(data)} bytes)'
