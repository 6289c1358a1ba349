"""Sockets, the clock and the limits of a run on the command line."""

import socket
import threading
from pathlib import Path

from cli_helper import rapidsim

CLIENT = r"""MODULE job
  PROC main()
    VAR socketdev s;
    VAR string text;
    SocketCreate s;
    SocketConnect s,"127.0.0.1",{port};
    SocketSend s\Str:="hello";
    SocketReceive s\Str:=text;
    TPWrite text;
    TPWrite CDate()+" "+CTime();
  ENDPROC
ENDMODULE
"""

STATION = """
[clock]
start = 2025-03-01T06:00:00
[[socket]]
accept = 5000
steps = [{ expect = "hello", send = "from the station" }]
"""


def test_a_station_says_who_answers_and_what_time_it_is(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(CLIENT.format(port=5000), encoding="utf-8")
    (tmp_path / "rapidsim.toml").write_text(STATION, encoding="utf-8")
    it = rapidsim("run", "job.mod", "--no-record", cwd=tmp_path)
    assert it.code == 0, it.out
    assert "from the station" in it.out
    assert "2025-03-01 06:00:00" in it.out
    other = rapidsim("run", "job.mod", "--no-record", "--start-time", "2026-01-02", cwd=tmp_path)
    assert "2026-01-02 00:00:00" in other.out


def test_the_network_is_used_only_where_it_is_allowed(tmp_path: Path) -> None:
    server = socket.create_server(("127.0.0.1", 0))
    port = server.getsockname()[1]
    (tmp_path / "job.mod").write_text(CLIENT.format(port=port), encoding="utf-8")
    refused = rapidsim("run", "job.mod", "--no-record", cwd=tmp_path)
    assert refused.code == 1
    assert "R112" in refused.out

    def answer() -> None:
        stream, _ = server.accept()
        with stream:
            stream.sendall(b"really " + stream.recv(100))

    thread = threading.Thread(target=answer)
    thread.start()
    it = rapidsim("run", "job.mod", "--no-record", "--allow-network", cwd=tmp_path)
    thread.join()
    server.close()
    assert it.code == 0, it.out
    assert "really hello" in it.out
    assert "answers take no simulated time" in it.out


def test_a_host_without_the_permission_is_wrong_usage(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(CLIENT.format(port=1), encoding="utf-8")
    it = rapidsim("run", "job.mod", "--network-host", "10.0.0.1", cwd=tmp_path)
    assert it.code == 2
    assert "--allow-network" in it.err
