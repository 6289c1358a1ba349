"""Sockets of programs talk to real peers while time passes."""

import socket
from base64 import b64encode
from collections.abc import Callable
from multiprocessing.connection import wait
from pathlib import Path

import pytest

from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine
from rapidsim.server.journal import read_journal
from rapidsim.server.loading import ReadyController, engine_of, ready
from rapidsim.server.messages import Answer, BeginFault, EndFaults, Request
from rapidsim.server.replay import replayed
from rapidsim.server.settings import EngineSettings
from rapidsim.server.wire import SocketWire

SERVER = """MODULE server
  VAR socketdev server;
  VAR socketdev client;
  PERS num served := 0;
  PERS num noClient := 0;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server, "192.168.125.1", PORT;
    SocketListen server;
    SocketAccept server, client \\Time:=2;
    WHILE TRUE DO
      SocketReceive client \\Str:=text \\Time:=60;
      served := served + 1;
      SocketSend client \\Str:="ok " + text;
    ENDWHILE
  ERROR
    SocketClose client;
    SocketClose server;
    IF ERRNO = ERR_SOCK_TIMEOUT noClient := noClient + 1;
    RETURN;
  ENDPROC
ENDMODULE
"""
CALLER = """MODULE caller
  VAR socketdev camera;
  PERS string answer := "";
  PROC main()
    SocketCreate camera;
    SocketConnect camera, "127.0.0.1", PORT \\Time:=5;
    SocketSend camera \\Str:="TRIG";
    SocketReceive camera \\Str:=answer \\Time:=5;
    SocketClose camera;
  ERROR
    answer := ValToStr(ERRNO = ERR_SOCK_TIMEOUT);
    SocketClose camera;
    RETURN;
  ENDPROC
ENDMODULE
"""

LETTERS = """MODULE letters
  VAR socketdev letters;
  PERS num served := 0;
  PERS string silent := "";
  PROC main()
    VAR string text;
    VAR string address;
    VAR num port;
    SocketCreate letters \\UDP;
    SocketBind letters, "192.168.125.1", PORT;
    WHILE TRUE DO
      SocketReceiveFrom letters \\Str:=text, address, port \\Time:=2;
      served := served + 1;
      SocketSendTo letters, address, port \\Str:="ok " + text;
    ENDWHILE
  ERROR
    silent := ValToStr(ERRNO = ERR_SOCK_TIMEOUT);
    SocketClose letters;
    RETURN;
  ENDPROC
ENDMODULE
"""
SENDER = """MODULE sender
  VAR socketdev letters;
  PERS string answer := "";
  PROC main()
    VAR string text;
    VAR string address;
    VAR num port;
    SocketCreate letters \\UDP;
    SocketSendTo letters, "127.0.0.1", PORT \\Str:="where";
    SocketReceiveFrom letters \\Str:=text, address, port \\Time:=5;
    answer := text;
    SocketClose letters;
  ERROR
    answer := ValToStr(ERRNO = ERR_SOCK_NET_UNREACH);
    SocketClose letters;
    RETURN;
  ENDPROC
ENDMODULE
"""


class Driven:
    """A controller whose time the test lets pass, with a network of its own."""

    def __init__(self, folder: Path, program: str, port: int) -> None:
        (folder / "main.mod").write_text(program.replace("PORT", str(port)))
        self.made: ReadyController = ready(
            RunRequest(paths=(str(folder / "main.mod"),), home=str(folder))
        )
        self.lines: list[str] = []
        self.wire = SocketWire()
        self.engine: Engine = engine_of(
            self.made,
            EngineSettings(request_s=0.05),
            lambda told: None,
            self.lines.append,
            self.wire,
        )
        self.wire.unread = self.engine.live.external_streams.unread

    def ask(self, action: str = "start", **form: str) -> None:
        self.engine.reply(Request("POST", "/rw/rapid/execution", {"action": action}, form))

    def value(self, name: str) -> str:
        """What a persistent is; asking lets 0.05 s pass."""
        reply = self.engine.reply(Request("GET", f"/rw/rapid/symbol/data/RAPID/T_ROB1/{name}"))
        assert isinstance(reply, Answer)
        return reply.items[0].fields["value"]

    def pass_time(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.05)):
            self.engine.reply(Request("GET", "/rw/rapid/execution"))

    def hear(self, until: Callable[[], bool]) -> None:
        """Let the network's doings take effect, 0.05 s pass after each, until something holds."""
        for _ in range(200):
            if until():
                return
            for one in self.wire.came(wait(self.wire.sockets(), self.wire.patience_s(0.2))):
                self.engine.reply(one)
                self.pass_time(0.05)
        raise AssertionError("nothing came")

    def end(self) -> None:
        """Switch off; the same life without a network gives the same journal."""
        self.engine.switch_off()
        self.wire.shut()
        told: list[str] = []
        replayed(self.made, read_journal(self.lines, "lines"), told.append)
        assert told == []


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


def test_a_client_talks_to_a_program_that_listens(tmp_path: Path) -> None:
    port = free_port()
    with recursion_limit(RUNNING_DEPTH):
        driven = Driven(tmp_path, SERVER, port)
        driven.ask(cycle="forever")
        with socket.create_connection(("127.0.0.1", port), timeout=20) as client:
            client.setblocking(False)
            said = bytearray()

            def has_said(text: bytes) -> bool:
                try:
                    said.extend(client.recv(100))
                except BlockingIOError:
                    return False
                return bytes(said) == text

            client.sendall(b"one")
            driven.hear(lambda: has_said(b"ok one"))
            client.sendall(b"two")
            driven.hear(lambda: has_said(b"ok oneok two"))
            assert driven.value("served") == "2"
        # It has closed: the program listens again, and nobody comes for two seconds.
        driven.hear(lambda: any('"over": true' in line for line in driven.lines))
        driven.pass_time(2.5)
        assert driven.value("noClient") == "1"
        with socket.create_connection(("127.0.0.1", port), timeout=20):
            driven.hear(lambda: any('"connection": -2' in line for line in driven.lines))
            driven.ask("stop")
            # Its port closes with the program's end.
            driven.ask("resetpp")
        with pytest.raises(OSError, match="refused"):
            socket.create_connection(("127.0.0.1", port), timeout=20)
        driven.end()


def test_connections_of_programs_are_delayed_repeated_broken_and_refused(tmp_path: Path) -> None:
    port = free_port()
    with recursion_limit(RUNNING_DEPTH):
        driven = Driven(tmp_path, SERVER, port)
        driven.ask(cycle="forever")

        def fail(kind: str, **keys: object) -> None:
            reply = driven.engine.reply(BeginFault({"kind": kind, "on": "socket", **keys}))
            assert isinstance(reply, Answer)

        def arrived(text: str) -> bool:
            return any(b64encode(text.encode()).decode() in line for line in driven.lines)

        with socket.create_connection(("127.0.0.1", port), timeout=20) as client:
            fail("delay", by=1.0, count=2)
            client.sendall(b"one")
            driven.hear(lambda: arrived("one"))
            assert driven.value("served") == "0"
            driven.pass_time(1.2)
            assert driven.value("served") == "1"
            fail("duplicate", count=1)
            client.sendall(b"two")
            driven.hear(lambda: arrived("two"))
            driven.pass_time(0.2)
            said = b""
            while len(said) < len(b"ok oneok twook two"):
                said += client.recv(100)
            assert said == b"ok oneok twook two"
            fail("drop")
            driven.pass_time(0.1)
            assert client.recv(100) == b""
        driven.engine.reply(EndFaults())
        fail("refuse")
        with socket.create_connection(("127.0.0.1", port), timeout=20) as client:
            driven.hear(lambda: any('"connection": -2' in line for line in driven.lines))
            assert client.recv(100) == b""
        driven.pass_time(2.5)
        assert driven.value("noClient") == "1"
        driven.end()


def test_a_program_calls_a_server_that_is_there_later_or_never(tmp_path: Path) -> None:
    port = free_port()
    with recursion_limit(RUNNING_DEPTH):
        driven = Driven(tmp_path, CALLER, port)
        driven.ask(cycle="once")
        assert driven.value("answer") == '""'
        with socket.create_server(("127.0.0.1", port)) as server:
            server.settimeout(20)
            peer, _ = server.accept()
            with peer:
                peer.setblocking(False)
                heard = bytearray()

                def is_triggered() -> bool:
                    try:
                        heard.extend(peer.recv(100))
                    except BlockingIOError:
                        return False
                    return heard == b"TRIG"

                driven.hear(is_triggered)
                peer.sendall(b"seen")
                driven.hear(lambda: driven.value("answer") == '"seen"')
        driven.ask(cycle="once")
        driven.pass_time(5.5)
        assert driven.value("answer") == '"TRUE"'
        driven.end()


def test_a_program_does_not_reach_other_computers_unasked(tmp_path: Path) -> None:
    with recursion_limit(RUNNING_DEPTH):
        driven = Driven(tmp_path, CALLER.replace("127.0.0.1", "192.0.2.1"), 9)
        driven.ask(cycle="once")
        assert driven.value("answer") == '"FALSE"'
        driven.end()


def datagrams(port: int = 0) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    opened.setblocking(False)
    try:
        opened.bind(("127.0.0.1", port))
    except OSError:
        opened.close()
        raise
    return opened


def has_arrived(at: socket.socket, text: bytes) -> bool:
    try:
        return at.recv(100) == text
    except BlockingIOError:
        return False


def test_two_clients_send_datagrams_to_a_program(tmp_path: Path) -> None:
    with datagrams() as found:
        port = found.getsockname()[1]
    with recursion_limit(RUNNING_DEPTH), datagrams() as first, datagrams() as second:
        driven = Driven(tmp_path, LETTERS, port)
        driven.ask(cycle="once")
        first.sendto(b"one", ("127.0.0.1", port))
        driven.hear(lambda: has_arrived(first, b"ok one"))
        second.sendto(b"two", ("127.0.0.1", port))
        driven.hear(lambda: has_arrived(second, b"ok two"))
        first.sendto(b"three", ("127.0.0.1", port))
        driven.hear(lambda: has_arrived(first, b"ok three"))
        assert driven.value("served") == "3"
        # The port is the program's; a second program of the computer cannot take it.
        with pytest.raises(OSError, match="in use"):
            datagrams(port)
        driven.pass_time(2.5)
        assert driven.value("silent") == '"TRUE"'
        datagrams(port).close()
        driven.end()


def test_a_program_sends_the_first_datagram(tmp_path: Path) -> None:
    with recursion_limit(RUNNING_DEPTH), datagrams() as peer:
        driven = Driven(tmp_path, SENDER, peer.getsockname()[1])
        driven.ask(cycle="once")
        driven.pass_time(0.1)
        data, address = peer.recvfrom(100)
        assert data == b"where"
        peer.sendto(b"here", address)
        driven.hear(lambda: driven.value("answer") == '"here"')
        driven.end()


def test_a_program_sends_no_datagrams_to_other_computers_unasked(tmp_path: Path) -> None:
    with recursion_limit(RUNNING_DEPTH):
        driven = Driven(tmp_path, SENDER.replace("127.0.0.1", "192.0.2.1"), 9)
        driven.ask(cycle="once")
        assert driven.value("answer") == '"TRUE"'
        driven.end()
