"""Sockets: scripts of the station, other ends in the program itself, real ports, and mistakes."""

import socket
import threading
from pathlib import Path
from typing import Any

import pytest
from simulation_program import Ran, ran
from simulation_tasks import ran as ran_tasks

from rapidsim.controller.cell.network import Network
from rapidsim.files import InputError
from rapidsim.station.read import read_io

SERVER = r"""MODULE cell
  VAR socketdev server;
  VAR socketdev client;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server,"192.168.125.1",1025;
    SocketListen server;
    SocketAccept server,client\Time:=WAIT_MAX;
    WHILE TRUE DO
      SocketReceive client\Str:=text\Time:=10;
      TPWrite "got "+text;
      SocketSend client\Str:="ok "+text;
    ENDWHILE
  ERROR
    IF ERRNO=ERR_SOCK_CLOSED THEN
      SocketClose client;
      SocketClose server;
      TPWrite "closed";
      RETURN;
    ENDIF
  ENDPROC
ENDMODULE
"""

CLIENT = r"""MODULE cell
  VAR socketdev camera;
  PROC main()
    VAR string text;
    SocketCreate camera;
    SocketConnect camera,"192.168.125.5",5000\Time:=3;
    FOR i FROM 1 TO 2 DO
      SocketSend camera\Str:="TRIG"+ValToStr(i);
      SocketReceive camera\Str:=text;
      TPWrite text;
    ENDFOR
    SocketClose camera;
    TPWrite ValToStr(SocketGetStatus(camera)=SOCKET_CLOSED);
  ENDPROC
ENDMODULE
"""


def with_peer(text: str, toml: str, folder: Path, **options: Any) -> Ran:
    file = folder / "io.toml"
    file.write_text(toml, encoding="utf-8")
    return ran(text, io=read_io(file), **options)


def told(it: Ran) -> list[tuple[float, str]]:
    return [(round(e.time_s, 3), e.message) for e in it.run.events if e.kind == "socket"]


def test_a_client_asks_and_the_program_answers(tmp_path: Path) -> None:
    peer = """
[[socket]]
connect = 1025
after = 0.5
steps = [
  { after = 1.0, send = "one" },
  { expect = "ok", after = 0.25, send = "two" },
  { expect = "ok two", close = true },
]
"""
    it = with_peer(SERVER, peer, tmp_path)
    assert (it.end, it.texts) == ("ended", ["got one", "got two", "closed"])
    client = "127.0.0.1:1025"
    assert told(it) == [
        (0.0, "listens on port 1025"),
        (0.5, f"accepted {client}"),
        (1.5, f'"one" came from {client}'),
        (1.5, f'sent "ok one" to {client}'),
        (1.75, f'"two" came from {client}'),
        (1.75, f'sent "ok two" to {client}'),
    ]
    assert told(with_peer(SERVER, peer, tmp_path)) == told(it)


def test_a_server_that_nobody_may_call_says_so_once(tmp_path: Path) -> None:
    text = SERVER.replace("WAIT_MAX", "2").replace("ERR_SOCK_CLOSED", "ERR_SOCK_TIMEOUT")
    it = ran(text)
    found = it.only("R115")
    assert found.span is not None
    assert "SocketAccept" in found.span.text
    assert "port 1025" in found.violation.message
    assert "connect = 1025" in (found.violation.help or "")
    late = '[[socket]]\nconnect = 1025\nafter = 9\nsteps = [{ send = "x" }]\n'
    assert "R115" not in [code for code, _ in with_peer(text, late, tmp_path).findings]


def test_a_camera_answers_each_trigger(tmp_path: Path) -> None:
    peer = r"""
[[socket]]
accept = "192.168.125.5:5000"
repeat = true
steps = [{ expect = "TRIG", after = 0.2, send = "12.5" }]
"""
    it = with_peer(CLIENT, peer, tmp_path)
    assert (it.end, it.texts) == ("ended", ["12.5", "12.5", "TRUE"])
    assert it.run.time_s == pytest.approx(0.4, abs=1e-3)
    assert it.findings == []


def test_without_a_peer_and_without_permission_the_run_says_so() -> None:
    it = ran(CLIENT)
    assert it.end == "error"
    error, warning = it.only("R101"), it.only("R112")
    told = "nothing listens at 192.168.125.5:5000 within 3 s (ERR_SOCK_TIMEOUT)"
    assert error.violation.message == told
    assert "--allow-network" in (warning.violation.help or "")
    assert it.run.time_s == pytest.approx(3.0)


def test_a_server_that_nobody_visits_does_not_hang() -> None:
    it = ran(SERVER)
    assert it.end == "error"
    assert "no [[socket]] of the station file connects to it" in it.only("R106").violation.message


def test_a_peer_that_waits_for_something_else_lets_the_time_run_out(tmp_path: Path) -> None:
    peer = '[[socket]]\naccept = 5000\nsteps = [{ expect = "trig", send = "1" }]\n'
    it = with_peer(CLIENT, peer, tmp_path)
    told = "nothing came from 192.168.125.5:5000 within 60 s (ERR_SOCK_TIMEOUT)"
    assert it.only("R101").violation.message == told
    assert it.run.time_s == pytest.approx(60.0)


def test_bytes_stay_until_they_are_read_and_states_are_told(tmp_path: Path) -> None:
    text = r"""MODULE cell
  VAR socketdev s;
  PROC main()
    VAR rawbytes raw;
    VAR byte bytes{4};
    VAR string text;
    VAR num n;
    TPWrite ValToStr(SocketGetStatus(s));
    SocketCreate s;
    TPWrite ValToStr(SocketGetStatus(s));
    SocketConnect s,"10.0.0.1",5000;
    TPWrite ValToStr(SocketGetStatus(s));
    WaitTime 1;
    TPWrite ValToStr(SocketPeek(s));
    SocketReceive s\Str:=text\ReadNoOfBytes:=2;
    SocketReceive s\Data:=bytes\NoRecBytes:=n;
    SocketReceive s\RawData:=raw;
    TPWrite text+" "+ValToStr(n)+" "+ValToStr(bytes{4})+" "+ValToStr(RawBytesLen(raw));
    SocketReceive s\Str:=text\Time:=0.5;
  ERROR
    IF ERRNO=ERR_SOCK_TIMEOUT TPWrite "time";
    IF ERRNO=ERR_SOCK_CLOSED TPWrite "closed";
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    peer = r"""
[[socket]]
accept = 5000
steps = [{ send = "abcd\u0001\u00ffxyz" }, { after = 2, close = true }]
"""
    it = with_peer(text, peer, tmp_path)
    assert it.texts == ["5", "1", "2", "9", "ab 4 255 3", "time"]


def test_two_tasks_talk_to_each_other() -> None:
    server = r"""
  VAR socketdev server;
  VAR socketdev client;
  PROC main()
    VAR string text;
    SocketCreate server;
    SocketBind server,"127.0.0.1",2000;
    SocketListen server;
    SocketAccept server,client\Time:=WAIT_MAX;
    SocketReceive client\Str:=text;
    TPWrite text;
    WaitTime 0.3;
    SocketSend client\Str:="pong";
    SocketClose client;
  ENDPROC
"""
    client = r"""
  VAR socketdev s;
  PROC main()
    VAR string text;
    WaitTime 1;
    SocketCreate s;
    SocketConnect s,"127.0.0.1",2000;
    SocketSend s\Str:="ping";
    SocketReceive s\Str:=text;
    TPWrite text;
    SocketReceive s\Str:=text;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_CLOSED);
    TRYNEXT;
  ENDPROC
"""
    it = ran_tasks({"T_ROB1": server, "T_COM": client}, robots=("T_ROB1",))
    assert it.texts == [(1.0, "ping"), (1.3, "pong"), (1.3, "TRUE")]


WRONG = r"""MODULE cell
  VAR socketdev s;
  VAR socketdev c;
  PROC main()
    VAR string text;
    {statement}
  ERROR
    TPWrite ValToStr(ERRNO={error});
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("statement", "error"),
    [
        ("SocketListen s;", "ERR_SOCK_CLOSED"),
        ("SocketCreate s; SocketListen s;", "ERR_SOCK_NOT_BOUND"),
        ('SocketCreate s; SocketBind s,"",70000;', "ERR_SOCK_ADDR_INVALID"),
        ('SocketCreate s; SocketBind s,"",1025; SocketBind s,"",1026;', "ERR_SOCK_IS_BOUND"),
        (
            'SocketCreate s; SocketBind s,"",1025; SocketCreate c; SocketBind c,"",1025;',
            "ERR_SOCK_ADDR_INUSE",
        ),
        (
            'SocketCreate s; SocketBind s,"",1025; SocketListen s; SocketCreate c;'
            'SocketBind c,"",1025;',
            "ERR_SOCK_ADDR_INUSE",
        ),
        (
            'SocketCreate s; SocketBind s,"",1025; SocketCreate c; SocketAccept s,c\\Time:=1;',
            "ERR_SOCK_NOT_BOUND",
        ),
        ("SocketCreate s; SocketSend s\\Str:=text;", "ERR_SOCK_NOT_CONN"),
        ('SocketCreate s; SocketBind s,"",1025; SocketListen s; SocketAccept s,c\\Time:=2;',
         "ERR_SOCK_TIMEOUT"),
        ("SocketCreate s; SocketCreate s;", "ERR_SOCK_IS_CONN"),
    ],
)  # fmt: skip
def test_mistakes_have_the_manuals_errors(statement: str, error: str) -> None:
    assert ran(WRONG.format(statement=statement, error=error)).texts == ["TRUE"]


def test_datagrams_reach_nobody_and_the_run_says_so() -> None:
    text = r"""MODULE cell
  VAR socketdev s;
  PROC main()
    VAR string text;
    VAR string from;
    VAR num port;
    SocketCreate s\UDP;
    SocketSendTo s,"10.0.0.1",4000\Str:="hello";
    SocketReceiveFrom s\Str:=text,from,port\Time:=2;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_TIMEOUT);
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    it = ran(text.replace("from", "sender"))
    assert it.texts == ["TRUE"]
    assert it.run.time_s == pytest.approx(2.0)
    assert [one.name for one in it.run.unsimulated] == ["SocketSendTo to 10.0.0.1:4000"]


ASKS = r"""MODULE cell
  VAR socketdev s;
  PROC main()
    VAR string text;
    VAR string sender;
    VAR num port;
    SocketCreate s\UDP;
    FOR i FROM 1 TO 2 DO
      SocketSendTo s,"127.0.0.1",PORT\Str:="question "+ValToStr(i);
      SocketReceiveFrom s\Str:=text,sender,port\Time:=20;
      TPWrite text+" "+sender+" "+ValToStr(port=PORT);
    ENDFOR
    SocketReceiveFrom s\Str:=text,sender,port\Time:=0.2;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_TIMEOUT);
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_datagrams_of_a_real_peer() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
        peer.bind(("127.0.0.1", 0))
        peer.settimeout(20)

        def answer() -> None:
            for _ in range(2):
                data, address = peer.recvfrom(100)
                peer.sendto(b"to " + data, address)

        thread = threading.Thread(target=answer)
        thread.start()
        it = ran(ASKS.replace("PORT", str(peer.getsockname()[1])), network=Network())
        thread.join()
    assert it.texts == [
        "to question 1 127.0.0.1 TRUE",
        "to question 2 127.0.0.1 TRUE",
        "TRUE",
    ]
    # What the network answers takes no time; the wait without effect takes its own.
    assert it.run.time_s == pytest.approx(0.2, abs=1e-3)


def test_tasks_send_each_other_datagrams_where_the_network_is_allowed() -> None:
    answers = r"""
VAR socketdev s;
VAR string text;
VAR string sender;
VAR num port;
PROC main()
  SocketCreate s\UDP;
  SocketBind s,"127.0.0.1",PORT;
  SocketReceiveFrom s\Str:=text,sender,port\Time:=10;
  SocketSendTo s,sender,port\Str:="to "+text;
ENDPROC
"""
    asks = r"""
VAR socketdev s;
VAR string text;
VAR string sender;
VAR num port;
PROC main()
  WaitTime 0.2;
  SocketCreate s\UDP;
  SocketSendTo s,"127.0.0.1",PORT\Str:="question";
  SocketReceiveFrom s\Str:=text,sender,port\Time:=10;
  TPWrite text;
ENDPROC
"""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as found:
        found.bind(("127.0.0.1", 0))
        port = str(found.getsockname()[1])
    programs = {"T_ROB1": asks.replace("PORT", port), "T_COM": answers.replace("PORT", port)}
    it = ran_tasks(programs, robots=("T_ROB1",), network=Network())
    assert [text for _, text in it.texts] == ["to question"]


def test_a_real_port_for_datagrams_may_be_taken_already() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        statement = rf'SocketCreate s\UDP; SocketBind s,"",{taken.getsockname()[1]};'
        text = WRONG.format(statement=statement, error="ERR_SOCK_ADDR_INUSE")
        assert ran(text, network=Network()).texts == ["TRUE"]


def test_datagrams_to_another_computer_need_its_name() -> None:
    text = ASKS.replace("127.0.0.1", "192.0.2.1").replace("PORT", "4000")
    it = ran(text.replace("ERR_SOCK_TIMEOUT", "ERR_SOCK_NET_UNREACH"), network=Network())
    assert it.texts[0] == "TRUE"


def test_the_station_refuses_what_datagrams_do_not_have(tmp_path: Path) -> None:
    file = tmp_path / "io.toml"
    file.write_text(
        """
[[socket]]
connect = 6000
udp = true
reconnect = true
steps = [{ send = "x", close = true }]
"""
    )
    with pytest.raises(InputError) as error:
        read_io(file)
    assert "socket.reconnect" in str(error.value)
    assert "socket.steps" in str(error.value)


def test_a_port_that_another_program_of_the_computer_has_cannot_be_bound() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        statement = f'SocketCreate s; SocketBind s,"",{taken.getsockname()[1]};'
        text = WRONG.format(statement=statement, error="ERR_SOCK_ADDR_INUSE")
        assert ran(text, network=Network()).texts == ["TRUE"]


def test_two_sockets_of_a_program_cannot_have_one_real_port() -> None:
    with socket.create_server(("127.0.0.1", 0)) as found:
        port = found.getsockname()[1]
    statement = (
        f'SocketCreate s; SocketBind s,"",{port}; SocketClose s; SocketCreate s;'
        f'SocketBind s,"",{port}; SocketCreate c; SocketBind c,"",{port};'
    )
    text = WRONG.format(statement=statement, error="ERR_SOCK_ADDR_INUSE")
    assert ran(text, network=Network()).texts == ["TRUE"]


def test_a_real_port_of_this_computer() -> None:
    server = socket.create_server(("127.0.0.1", 0))
    port = server.getsockname()[1]

    def answer() -> None:
        stream, _ = server.accept()
        with stream:
            stream.sendall(b"you said " + stream.recv(100))

    thread = threading.Thread(target=answer)
    thread.start()
    text = CLIENT.replace('"192.168.125.5",5000', f'"127.0.0.1",{port}').replace("TO 2", "TO 1")
    it = ran(text, network=Network())
    thread.join()
    server.close()
    assert it.texts == ["you said TRIG1", "TRUE"]


def test_another_computer_needs_to_be_named() -> None:
    it = ran(CLIENT, network=Network())
    assert "--network-host 192.168.125.5" in it.only("R101").violation.message


def test_mistakes_in_the_table_are_told_together(tmp_path: Path) -> None:
    file = tmp_path / "io.toml"
    file.write_text(
        """
[[socket]]
accept = 70000
repeat = true
steps = [{ send = "x" }]
[[socket]]
steps = []
""",
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        read_io(file)
    text = str(caught.value)
    assert "socket 1.accept: a port is needed" in text
    assert "socket 1.repeat: a step must `expect` something" in text
    assert "socket 2: give either `accept` for a server or `connect` for a client" in text


def test_tasks_that_wait_for_clients_do_not_wait_for_each_other() -> None:
    def server(port: int) -> str:
        return f"""
VAR socketdev door;
VAR socketdev client;
PROC main()
  SocketCreate door;
  SocketBind door,"127.0.0.1",{port};
  SocketListen door;
  SocketAccept door,client\\Time:=WAIT_MAX;
ENDPROC
"""

    it = ran_tasks({"T_ROB1": server(5000), "T_ROB2": server(5001)})
    found = it.only("R106")
    assert "waits for a client at port 500" in found.violation.message
    assert "--allow-network" in (found.help or "")
