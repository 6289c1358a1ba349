"""Entry point of the process in which the program runs under the debugger."""

from __future__ import annotations

import os
import sys
import traceback
from typing import Any

from rapidsim.dap.checkpoints import HAS_COPIES, Checkpoints
from rapidsim.dap.link import AdapterEnded, AdapterLink
from rapidsim.dap.program import DebuggedProgram, LaunchError
from rapidsim.dap.requests import HANDLERS
from rapidsim.dap.session import DebugSession
from rapidsim.dap.state import SessionState
from rapidsim.dap.wire import Message, read_message


def main(incoming: int, outgoing: int, alive: int) -> None:
    """Run one session over descriptors of pipes."""
    link = AdapterLink(os.fdopen(incoming, "rb"), os.fdopen(outgoing, "wb"))
    first = read_message(link.incoming)
    if first is None:
        return
    try:
        _session(link, first, alive)
    except AdapterEnded:
        pass
    except BaseException:
        link.output(f"rapidsim has a defect:\n{traceback.format_exc()}", "stderr")
        link.event("terminated")
    link.ended()


def _session(link: AdapterLink, first: Message, alive: int) -> None:
    launch, state = first["launch"], first["state"]
    arguments: dict[str, Any] = launch.get("arguments") or {}
    try:
        program = DebuggedProgram.launched(arguments)
    except LaunchError as error:
        link.output(str(error), "stderr")
        link.refuse(launch, str(error).partition("\n")[0])
        link.event("terminated")
        return
    state_then = SessionState() if state is None else SessionState.read(state)
    checkpoints = Checkpoints(alive) if HAS_COPIES else None
    session = DebugSession(link, program.files, state_then, checkpoints, HANDLERS)
    if state is None:
        link.respond(launch)
        if not session.configure(stops_on_entry=bool(arguments.get("stopOnEntry"))):
            return
    session.execute(program.run)


if __name__ == "__main__":
    received, sent = os.dup(0), os.dup(1)
    # What anything prints must not get between the messages.
    os.dup2(2, 1)
    main(received, sent, int(sys.argv[1]))
