"""What comes from outside a run: bytes and datagrams of peers, answers of operators, files."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from rapidsim.controller.cell.datagrams import MOST_WAITING, DatagramTable, Mailbox
from rapidsim.controller.cell.external_streams import ExternalStreams
from rapidsim.controller.cell.operator import OperatorDialog, parse_key, parse_number
from rapidsim.controller.cell.outside_datagrams import OutsideMailboxes
from rapidsim.controller.cell.pendant import Pendant, Question
from rapidsim.controller.cell.socket_scripts import SocketScript, SocketStep
from rapidsim.controller.cell.streams import Port, ScriptedPeer, StreamEnd, connected
from rapidsim.language.error_numbers import ERR_SOCK_ADDR_INUSE, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.language.sockets import Datagram

Later = Callable[[float], None]


class Network:
    """Notes what programs ask of the network."""

    def __init__(self) -> None:
        self.calls: list[tuple[object, ...]] = []

    def listen(self, port: int, address: str) -> None:
        self.calls.append(("listen", port, address))

    def unlisten(self, port: int) -> None:
        self.calls.append(("unlisten", port))

    def connect(self, number: int, address: str, port: int) -> None:
        self.calls.append(("connect", number, address, port))

    def send(self, number: int, data: bytes) -> None:
        self.calls.append(("send", number, data))

    def close(self, number: int) -> None:
        self.calls.append(("close", number))

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        self.calls.append(("open", port, address, is_bound))

    def close_mailbox(self, port: int) -> None:
        self.calls.append(("close", port))

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        self.calls.append(("send", port, address, to_port, data))

    def taken(self) -> list[tuple[object, ...]]:
        """The calls since the last time."""
        calls, self.calls = self.calls, []
        return calls


def test_a_client_is_served_at_a_port_that_a_program_listens_at() -> None:
    network, port = Network(), Port(5000)
    streams = ExternalStreams(network)
    streams.opened(port, "0.0.0.0")
    streams.came(-1, 5000, "10.0.0.7:4321", 1.0)
    streams.came(-2, 5001, "10.0.0.7:4322", 1.0)
    assert network.taken() == [("listen", 5000, "0.0.0.0"), ("close", -2)]
    (near,) = port.waiting
    assert near.peer == "10.0.0.7:4321"
    assert streams.numbers == (-1,)
    streams.arrived(-1, b"abc", 1.1)
    streams.arrived(-9, b"lost", 1.1)
    assert bytes(near.received) == b"abc"
    assert (streams.unread(-1), streams.unread(-9)) == (3, 0)
    near.send(b"answer", 1.2)
    near.send(b"more", 1.3)
    assert network.taken() == [("send", -1, b"answer"), ("send", -1, b"more")]
    near.close(1.4)
    assert network.taken() == [("close", -1)]
    assert not streams.numbers
    streams.ended(-1, 1.5)
    streams.closed(Port(5000))
    assert network.taken() == []
    streams.closed(port)
    assert network.taken() == [("unlisten", 5000)]


def test_a_program_is_connected_once_its_request_is_answered() -> None:
    network = Network()
    streams = ExternalStreams(network)
    assert streams.called("10.0.0.1", 80) is None
    assert streams.called("10.0.0.1", 80) is None
    assert streams.called("10.0.0.1", 81) is None
    assert network.taken() == [("connect", 1, "10.0.0.1", 80), ("connect", 2, "10.0.0.1", 81)]
    streams.came(1, 80, "", 1.0)
    near = streams.called("10.0.0.1", 80)
    assert near is not None
    assert near.peer == "10.0.0.1:80"
    streams.ended(1, 2.0)
    assert near.has_ended
    assert not streams.numbers
    # A request that is given up is closed, answered or not.
    streams.hung_up("10.0.0.1", 81, 2.0)
    assert network.taken() == [("close", 2)]
    streams.came(2, 81, "", 2.1)
    assert network.taken() == [("close", 2)]
    assert streams.called("10.0.0.1", 80) is None
    streams.came(3, 80, "", 3.0)
    streams.hung_up("10.0.0.1", 80, 3.1)
    assert network.taken() == [("connect", 3, "10.0.0.1", 80), ("close", 3)]
    assert not streams.numbers
    streams.hung_up("10.0.0.1", 99, 3.2)
    assert network.taken() == []


def scripted(*steps: SocketStep, repeats: bool = False) -> Iterator[object]:
    near, far = connected("script", "program")
    later: list[tuple[float, object]] = []
    ended: list[float] = []
    script = SocketScript(port=1, steps=steps, serves=True, repeats=repeats)
    peer = ScriptedPeer(script, far, lambda at, act: later.append((at, act)), ended.append)
    far.notice = peer.notice
    yield near
    yield later
    yield ended


def test_a_script_answers_what_it_expects_after_its_delay() -> None:
    steps = SocketStep(expect=b"TRIG", after_s=0.2, send=b"12"), SocketStep(expect=b"Q", close=True)
    near, later, ended = scripted(*steps)
    assert isinstance(near, StreamEnd)
    near.send(b"xxTR", 1.0)
    assert later == []
    near.send(b"IGQ", 1.5)
    ((at, act),) = later
    assert at == pytest.approx(1.7)
    assert near.received == b""
    act(1.7)
    assert near.received == b"12"
    assert near.has_ended
    assert ended == [1.7]
    near.send(b"TRIG", 2.0)
    assert len(later) == 1


def test_a_script_repeats_its_steps_until_the_program_closes() -> None:
    near, _, ended = scripted(SocketStep(expect=b"A", send=b"1"), repeats=True)
    assert isinstance(near, StreamEnd)
    near.send(b"AA", 1.0)
    assert near.received == b"11"
    near.close(2.0)
    assert ended == [2.0]
    assert not near.is_open


def test_datagrams_go_to_the_mailbox_of_their_port() -> None:
    network, box = Network(), Mailbox("127.0.0.1", 3000)
    outside = OutsideMailboxes(network)
    outside.opened(box, is_bound=True)
    outside.sent(box, "10.0.0.9", 4000, b"out")
    outside.arrived(3000, "10.0.0.9:4000", b"in")
    outside.arrived(3001, "10.0.0.9:4000", b"lost")
    assert network.taken() == [
        ("open", 3000, "127.0.0.1", True),
        ("send", 3000, "10.0.0.9", 4000, b"out"),
    ]
    (datagram,) = box.received
    assert (datagram.data, datagram.address, datagram.port) == (b"in", "10.0.0.9", 4000)
    for _ in range(MOST_WAITING + 5):
        outside.arrived(3000, "10.0.0.9:4000", b"in")
    assert len(box.received) == MOST_WAITING
    outside.closed(Mailbox("127.0.0.1", 3000))
    assert network.taken() == []
    outside.closed(box)
    assert network.taken() == [("close", 3000)]
    outside.arrived(3000, "10.0.0.9:4000", b"late")
    assert len(box.received) == MOST_WAITING
    assert Mailbox("192.168.0.1", 1).sender == "192.168.0.1"
    assert Mailbox("", 1).sender == Mailbox("localhost", 1).sender != ""


def table(*scripts: SocketScript) -> tuple[DatagramTable, list[tuple[float, Later]]]:
    """A table of ports, and what its scripts have scheduled."""
    later: list[tuple[float, Later]] = []
    return DatagramTable(scripts, lambda at, act: later.append((at, act))), later


def in_box(mailbox: Mailbox) -> list[tuple[bytes, str, int]]:
    found = [(one.data, one.address, one.port) for one in mailbox.received]
    mailbox.received.clear()
    return found


def test_a_datagram_goes_to_a_script_a_task_or_the_network() -> None:
    camera = SocketScript(
        port=2000,
        steps=(SocketStep(expect=b"Q", send=b"A"),),
        serves=True,
        is_datagrams=True,
        repeats=True,
    )
    ports, _ = table(camera)
    near, other, network = Mailbox(), Mailbox(), Network()
    ports.bind(other, "127.0.0.1", 3000, 0.0)
    assert ports.send(near, "10.0.0.5", 2000, b"Q", 1.0)
    assert in_box(near) == [(b"A", "10.0.0.5", 2000)]
    assert (near.port, near.talks_to_script) == (49152, True)
    assert ports.send(near, "localhost", 3000, b"hello", 1.0)
    assert ports.send(near, "127.0.0.1", 3000, b"again", 1.0)
    assert in_box(other) == [(b"hello", "127.0.0.1", 49152), (b"again", "127.0.0.1", 49152)]
    assert not ports.send(near, "10.0.0.9", 3000, b"far", 1.0)
    assert not ports.send(near, "127.0.0.1", 3001, b"nobody", 1.0)
    assert in_box(other) == []
    ports.outside = OutsideMailboxes(network)
    assert ports.send(near, "10.0.0.9", 3000, b"far", 1.0)
    assert network.taken() == [("send", 49152, "10.0.0.9", 3000, b"far")]
    second = Mailbox()
    assert ports.send(second, "10.0.0.9", 3000, b"far", 1.0)
    assert network.taken()[0] == ("open", 49153, "", False)
    with pytest.raises(RapidError, match="another socket has port 3000 already") as caught:
        ports.bind(second, "127.0.0.1", 3000, 2.0)
    assert caught.value.errno == ERR_SOCK_ADDR_INUSE
    near.deliver(Datagram(b"late", "", 0))
    ports.close(near)
    assert network.taken() == []  # It was opened before there was a network.
    assert in_box(near) == []
    ports.close(other)
    ports.bind(second, "127.0.0.1", 3000, 2.0)
    assert ports.is_scripted(2000, serves=True)
    assert not ports.is_scripted(2000, serves=False)
    assert not ports.is_scripted(3000, serves=True)


def test_a_script_that_sends_first_waits_for_its_port() -> None:
    first = SocketScript(
        port=3000, steps=(SocketStep(send=b"1"),), serves=False, is_datagrams=True, after_s=0.5
    )
    ports, later = table(first)
    mailbox = Mailbox()
    ports.bind(mailbox, "127.0.0.1", 3001, 1.0)
    assert later == []
    ports.close(mailbox)
    ports.bind(mailbox, "127.0.0.1", 3000, 1.0)
    ((at, act),) = later
    assert at == pytest.approx(1.5)
    assert in_box(mailbox) == []
    act(1.5)
    assert in_box(mailbox) == [(b"1", "127.0.0.1", 60000)]
    again, later = table(first)
    again.bind(mailbox, "127.0.0.1", 3000, 1.0)
    again.close(mailbox)
    later[0][1](1.5)
    assert in_box(mailbox) == []


def test_a_port_that_the_network_refuses_is_not_taken() -> None:
    class Full(Network):
        def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
            raise rapid_error(ERR_SOCK_ADDR_INUSE, "full")

    ports, _ = table()
    ports.outside = OutsideMailboxes(Full())
    mailbox = Mailbox("1.2.3.4", 7)
    with pytest.raises(RapidError, match="full"):
        ports.bind(mailbox, "127.0.0.1", 3000, 0.0)
    assert (mailbox.address, mailbox.port) == ("1.2.3.4", 7)
    ports.require_free(3000)


@pytest.mark.parametrize(
    ("text", "number"), [("12", 12.0), (" -0.5e1 ", -5.0), ("", None), ("inf", None), ("x", None)]
)
def test_a_number_is_finite(text: str, number: float | None) -> None:
    assert parse_number(text) == number


@pytest.mark.parametrize(
    ("text", "index"),
    [("yes", 0), (" NO ", 2), ("1", 0), ("3", 2), ("2", None), ("4", None), ("", None)],
)
def test_a_key_is_meant_by_its_text_or_its_number(text: str, index: int | None) -> None:
    assert parse_key(text, ("Yes", "", "No ")) == index


def dialog(*lines: str, is_interactive: bool = False) -> tuple[OperatorDialog, list[str]]:
    asked: list[str] = []
    rest = list(lines)

    def answer(prompt: str) -> str | None:
        asked.append(prompt)
        return rest.pop(0) if rest else None

    return OperatorDialog(answer, is_interactive), asked


def test_a_person_is_asked_again_and_a_file_is_not() -> None:
    person, asked = dialog("a", "7", is_interactive=True)
    answer = person.number("How many?")
    assert answer is not None
    assert (answer.value, answer.findings) == (7.0, ())
    assert asked == ["How many?", "`a` is not a number, such as 12 or -0.5. How many?"]
    person, asked = dialog("a", "b", is_interactive=True)
    choice = person.choice("Go?", ("", "B"))
    assert choice is not None
    assert choice.value == 1
    assert asked == ["Go? B", "`a` is not one of the keys. Go? B"]
    file, asked = dialog("a", "a")
    number, key = file.number("How many?"), file.choice("Go?", ("", "B", "C"))
    assert number is not None
    assert key is not None
    said = [type(one).__name__ for one in (*number.findings, *key.findings)]
    assert said == ["AnswerNotANumber", "AnswerNotAChoice"]
    assert key.value == 1
    assert len(asked) == 2


def test_without_an_answer_a_question_has_its_default_unless_it_ends() -> None:
    nobody = OperatorDialog(None)
    assert nobody.number("?", ends=True) is None
    assert nobody.choice("?", ("A",), ends=True) is None
    assert nobody.text("?", "p", ends=True) is None
    number, key, text = nobody.number("?"), nobody.choice("?", ("", "B")), nobody.text("?", "p")
    assert number is not None
    assert key is not None
    assert text is not None
    assert (key.value, text.value) == (1, "p")
    for one in (number, key, text):
        assert [type(finding).__name__ for finding in one.findings] == ["QuestionUnanswered"]
    said, _ = dialog("x")
    answer = said.text("?", "p")
    assert answer is not None
    assert (answer.value, answer.findings) == ("x", ())


def test_a_question_stays_until_a_client_answers_it() -> None:
    pendant = Pendant()
    pendant.begin("T_ROB1", "TPReadFK")
    assert pendant.ask("T_ROB1", "Go?", int, ("Yes", "No")) is None
    assert pendant.questions["T_ROB1"] == Question("T_ROB1", "TPReadFK", "Go?", int, ("Yes", "No"))
    with pytest.raises(ValueError, match="`x` is none of Yes / No"):
        pendant.answer("T_ROB1", "x")
    assert not pendant.has_answer("T_ROB1")
    pendant.answer("T_ROB1", "no")
    assert pendant.has_answer("T_ROB1")
    assert pendant.questions == {}
    assert pendant.ask("T_ROB1", "Go?", int, ("Yes", "No")) == 1
    assert not pendant.has_answer("T_ROB1")
    with pytest.raises(LookupError):
        pendant.answer("T_ROB1", "no")
    assert pendant.ask("T_ROB2", "How many?", float, proposal="3") is None
    assert pendant.questions["T_ROB2"].instruction == ""
    assert pendant.questions["T_ROB2"].proposal == "3"
    with pytest.raises(ValueError, match="`x` is not a number"):
        pendant.answer("T_ROB2", "x")
    pendant.answer("T_ROB2", "0")
    assert pendant.has_answer("T_ROB2")
    pendant.withdraw("T_ROB2")
    assert not pendant.has_answer("T_ROB2")
    pendant.ask("T_ROB2", "Name?", str)
    pendant.answer("T_ROB2", "")
    assert pendant.ask("T_ROB2", "Name?", str) == ""
    pendant.ask("T_ROB2", "Name?", str)
    pendant.withdraw("T_ROB2")
    assert pendant.questions == {}
