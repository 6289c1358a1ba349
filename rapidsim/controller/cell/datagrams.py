"""Datagrams (UDP) between the program and its peers: scripts, other tasks, the network.

A datagram arrives at once and as a whole, or is lost without notice.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Final, Protocol

from rapidsim.controller.cell.socket_scripts import SocketScript
from rapidsim.controller.cell.streams import LOCAL, Schedule, ScriptedPeer, StreamEnd, connected
from rapidsim.language.error_numbers import ERR_SOCK_ADDR_INUSE, rapid_error
from rapidsim.language.sockets import Datagram

MOST_WAITING: Final = 1000
"""Maximum number of datagrams that wait for a program; later ones are lost."""
_OWN_HOST: Final = "127.0.0.1"
_FIRST_OWN_PORT: Final = 49152
"""First port for sockets without SocketBind."""
_FIRST_SCRIPT_PORT: Final = 60000
"""First port of scripts that send first."""


@dataclass(eq=False, slots=True)
class Mailbox:
    """A program's socket for datagrams; implements `language.sockets.DatagramPort`."""

    address: str = ""
    port: int = 0
    received: deque[Datagram] = field(default_factory=deque)
    talks_to_script: bool = False
    """Whether it has sent to a script, which may answer."""

    def deliver(self, datagram: Datagram) -> None:
        """Deliver a datagram, unless too many wait."""
        if len(self.received) < MOST_WAITING:
            self.received.append(datagram)

    @property
    def sender(self) -> str:
        """Source address of its datagrams."""
        return _OWN_HOST if self.address in LOCAL else self.address


class OutsideDatagrams(Protocol):
    """The network beyond scripts and tasks; see `outside_datagrams`."""

    def opened(self, mailbox: Mailbox, *, is_bound: bool) -> None:
        """Handle a new port of a program; `is_bound` if SocketBind opened it."""
        ...

    def closed(self, mailbox: Mailbox) -> None:
        """Handle the release of a port by a program."""
        ...

    def sent(self, mailbox: Mailbox, address: str, port: int, data: bytes) -> None:
        """Handle a datagram that a program has sent."""
        ...


@dataclass(eq=False, slots=True)
class _Conversation:
    """A script and the mailbox that it answers."""

    near: StreamEnd
    mailbox: Mailbox
    address: str
    """Address of the script, as used by the program."""
    port: int

    def answered(self, now_s: float) -> None:
        """Deliver all that the script has sent as one datagram."""
        del now_s
        data = bytes(self.near.received)
        self.near.received.clear()
        if data:
            self.mailbox.deliver(Datagram(data, self.address, self.port))


class DatagramTable:
    """The ports of programs for datagrams, and the scripts that are their peers."""

    def __init__(self, scripts: Sequence[SocketScript], schedule: Schedule) -> None:
        """Make the table; scripts act at their own times."""
        self._scripts = tuple(scripts)
        self._schedule = schedule
        self.outside: OutsideDatagrams | None = None
        """None if the only peers are scripts and tasks."""
        self._mailboxes: dict[int, Mailbox] = {}
        self._conversations: dict[int, _Conversation] = {}
        """By the index of the script."""
        self._next_port = _FIRST_OWN_PORT

    def is_scripted(self, port: int, *, serves: bool) -> bool:
        """Whether a script serves a port, or sends to it."""
        return any(script.port == port and script.serves == serves for script in self._scripts)

    def require_free(self, port: int) -> None:
        """Refuse a port that another socket has.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        if port in self._mailboxes:
            raise rapid_error(ERR_SOCK_ADDR_INUSE, f"another socket has port {port} already")

    def bind(self, mailbox: Mailbox, address: str, port: int, now_s: float) -> None:
        """Bind a mailbox to a port; scripts that send to it start.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        self.require_free(port)
        before = (mailbox.address, mailbox.port)
        mailbox.address, mailbox.port = address, port
        if self.outside is not None and not self.is_scripted(port, serves=False):
            try:
                self.outside.opened(mailbox, is_bound=True)
            except Exception:
                mailbox.address, mailbox.port = before
                raise
        self._mailboxes[port] = mailbox
        for index, script in enumerate(self._scripts):
            if script.port == port and not script.serves and index not in self._conversations:
                self._schedule(now_s + script.after_s, partial(self._set_out, index, mailbox))

    def send(self, mailbox: Mailbox, address: str, port: int, data: bytes, now_s: float) -> bool:
        """Send a datagram to a script, a task or the network.

        Returns:
            Whether any of them receives it.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH for a host that the program may not contact.
        """
        if not mailbox.port:
            self._give_port(mailbox)
        conversation = self._script_at(mailbox, address, port, now_s)
        if conversation is not None:
            mailbox.talks_to_script = True
            conversation.mailbox = mailbox
            conversation.near.send(data, now_s)
            return True
        other = self._mailboxes.get(port)
        if other is not None and (address in LOCAL or address == other.address):
            other.deliver(Datagram(data, mailbox.sender, mailbox.port))
            return True
        if self.outside is None:
            return False
        self.outside.sent(mailbox, address, port, data)
        return True

    def close(self, mailbox: Mailbox) -> None:
        """Release the port of a mailbox."""
        if self._mailboxes.get(mailbox.port) is mailbox:
            del self._mailboxes[mailbox.port]
            if self.outside is not None:
                self.outside.closed(mailbox)
        mailbox.received.clear()

    def _give_port(self, mailbox: Mailbox) -> None:
        while self._next_port in self._mailboxes:
            self._next_port += 1
        mailbox.port = self._next_port
        self._next_port += 1
        self._mailboxes[mailbox.port] = mailbox
        if self.outside is not None:
            self.outside.opened(mailbox, is_bound=False)

    def _script_at(
        self, mailbox: Mailbox, address: str, port: int, now_s: float
    ) -> _Conversation | None:
        """The conversation with the script at an address; None if no script is there."""
        for known in self._conversations.values():
            if (known.address, known.port) == (address, port):
                return known
        for index, script in enumerate(self._scripts):
            if script.serves and script.port == port and script.address in ("", address):
                return self._begin(index, mailbox, address, port, now_s)
        return None

    def _set_out(self, index: int, mailbox: Mailbox, now_s: float) -> None:
        """Start a script that sends first."""
        if self._mailboxes.get(mailbox.port) is mailbox:
            address = self._scripts[index].address or _OWN_HOST
            self._begin(index, mailbox, address, _FIRST_SCRIPT_PORT + index, now_s)

    def _begin(
        self, index: int, mailbox: Mailbox, address: str, port: int, now_s: float
    ) -> _Conversation:
        near, far = connected(f"{address}:{port}", "the program")
        conversation = _Conversation(near, mailbox, address, port)
        near.notice = conversation.answered
        peer = ScriptedPeer(self._scripts[index], far, self._schedule, lambda _: None)
        far.notice = peer.notice
        self._conversations[index] = conversation
        peer.notice(now_s)
        return conversation
