"""Findings of a run about sockets (family R)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class NobodyAnswers(Violation):
    r"""The program connects to a server, and nobody is there.

    A run reaches no network unless it is allowed to. Say in the station file who answers: a table
    `[[socket]]` with `accept = 1025` and `steps` of what it expects and sends. Or let the run use
    the network with `--allow-network`.

    ## Example

        MODULE example
          VAR socketdev camera;
          PROC main()
            SocketCreate camera;
            SocketConnect camera,"192.168.125.5",1025;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR socketdev camera;
          PROC main()
            SocketCreate camera;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R112"
    name: ClassVar[str] = "nobody-answers"
    template: ClassVar[str] = "nobody answers at {place}; the connection was not made"
    severity: ClassVar[Severity] = Severity.WARNING

    place: str

    @property
    def help(self) -> str:
        """Who may answer."""
        return "say who does in a [[socket]] table of the station, or give `--allow-network`"


@dataclass(frozen=True)
class NobodyConnects(Violation):
    r"""The program waits for a client, and none comes in time.

    A run has no clients but those that somebody names. Say in the station file who connects: a
    table `[[socket]]` with `connect = 1025` and `steps` of what it sends and expects. Or let the
    run use the network with `--allow-network`.

    ## Example

        MODULE example
          VAR socketdev server;
          VAR socketdev host;
          PROC main()
            SocketCreate server;
            SocketBind server,"127.0.0.1",1025;
            SocketListen server;
            SocketAccept server,host\Time:=2;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR socketdev server;
          PROC main()
            SocketCreate server;
            SocketBind server,"127.0.0.1",1025;
            SocketListen server;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R115"
    name: ClassVar[str] = "nobody-connects"
    template: ClassVar[str] = "no client came to port {port} in time"
    severity: ClassVar[Severity] = Severity.WARNING

    port: int

    @property
    def help(self) -> str:
        """Who may come."""
        return (
            f"say who does: a [[socket]] table with `connect = {self.port}` in rapidsim.toml, or "
            "give `--allow-network`"
        )
