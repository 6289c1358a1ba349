"""What a controller of these tests answers to sockets."""

from rapidsim.language.sockets import Connection, Datagram, DatagramPort, Listener

_WHERE = "sockets are tested with a cell around them"


class NoSockets:
    """Implements `language.controller.Sockets`, of which no routine tested here may ask."""

    def bind_port(self, address: str, port: int) -> Listener:
        raise AssertionError(_WHERE)

    def open_port(self, listener: Listener) -> None:
        raise AssertionError(_WHERE)

    def accept_client(self, listener: Listener, *, max_time: float | None) -> Connection | None:
        raise AssertionError(_WHERE)

    def connect_socket(
        self, address: str, port: int, *, max_time: float | None
    ) -> Connection | None:
        raise AssertionError(_WHERE)

    def send_bytes(self, connection: Connection, data: bytes) -> None:
        raise AssertionError(_WHERE)

    def await_bytes(self, connection: Connection, count: int, *, max_time: float | None) -> bool:
        raise AssertionError(_WHERE)

    def close_socket(self, listener: Listener | None, connection: Connection | None) -> None:
        raise AssertionError(_WHERE)

    def open_datagrams(self) -> DatagramPort:
        raise AssertionError(_WHERE)

    def bind_datagrams(self, socket: DatagramPort, address: str, port: int) -> None:
        raise AssertionError(_WHERE)

    def send_datagram(self, socket: DatagramPort, address: str, port: int, data: bytes) -> None:
        raise AssertionError(_WHERE)

    def await_datagram(self, socket: DatagramPort, *, max_time: float | None) -> Datagram | None:
        raise AssertionError(_WHERE)

    def close_datagrams(self, socket: DatagramPort) -> None:
        raise AssertionError(_WHERE)
