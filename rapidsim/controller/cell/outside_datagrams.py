"""Datagrams between programs and real peers, which take effect at instants of virtual time.

A `DatagramWire` sends datagrams of programs; the owner of the clock delivers those of peers here.
Both identify a program's port by its number in the run.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from rapidsim.controller.cell.datagrams import Mailbox
from rapidsim.language.sockets import Datagram


class DatagramWire(Protocol):
    """Network side of the datagrams of programs."""

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        """Open a port for datagrams: the one of this number if `is_bound`, else any.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        ...

    def close_mailbox(self, port: int) -> None:
        """Release a port."""
        ...

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        """Send a datagram from a port.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH for a host that programs may not contact.
        """
        ...


@dataclass(slots=True, eq=False)
class OutsideMailboxes:
    """Implements `datagrams.OutsideDatagrams`: the mailboxes of a cell by their ports."""

    wire: DatagramWire
    _mailboxes: dict[int, Mailbox] = field(default_factory=dict)

    def opened(self, mailbox: Mailbox, *, is_bound: bool) -> None:
        """Open the port of a program; raises as `DatagramWire.open_mailbox` does."""
        self.wire.open_mailbox(mailbox.port, mailbox.address, is_bound=is_bound)
        self._mailboxes[mailbox.port] = mailbox

    def closed(self, mailbox: Mailbox) -> None:
        """Release the port of a program."""
        if self._mailboxes.get(mailbox.port) is mailbox:
            del self._mailboxes[mailbox.port]
            self.wire.close_mailbox(mailbox.port)

    def sent(self, mailbox: Mailbox, address: str, port: int, data: bytes) -> None:
        """Send a program's datagram; raises as `DatagramWire.send_datagram` does."""
        self.wire.send_datagram(mailbox.port, address, port, data)

    def arrived(self, port: int, peer: str, data: bytes) -> None:
        """Deliver a datagram to a port from a peer, `address:port`."""
        mailbox = self._mailboxes.get(port)
        if mailbox is not None:
            address, _, number = peer.rpartition(":")
            mailbox.deliver(Datagram(data, address, int(number)))
