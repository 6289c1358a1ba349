"""The child process in which the program runs, as the adapter sees it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass
from typing import IO

IS_WINDOWS = sys.platform == "win32"


@dataclass(eq=False)
class DebuggeeProcess:
    """A debuggee with all copies of it."""

    requests: IO[bytes]
    messages: IO[bytes]
    group: int
    """Process group of the debuggee and its copies; on Windows its process."""
    alive: int
    """Descriptor of a pipe whose end the waiting copies see."""

    def kill(self) -> None:
        """End all processes at once."""
        with suppress(OSError):
            if IS_WINDOWS:
                os.kill(self.group, signal.SIGTERM)
            else:
                os.killpg(self.group, signal.SIGKILL)

    def close(self) -> None:
        """End all processes and close the pipes; nobody may be reading them."""
        self.kill()
        os.close(self.alive)
        for stream in (self.requests, self.messages):
            with suppress(OSError):
                stream.close()


def start_debuggee(folder: str | None) -> DebuggeeProcess:
    """Start a debuggee.

    Args:
        folder: Its working directory; None for that of this process.

    Raises:
        OSError: If the folder does not exist.
    """
    reader, alive = os.pipe()
    try:
        process = subprocess.Popen(
            [sys.executable, "-m", "rapidsim.dap.debuggee", str(reader)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            pass_fds=() if IS_WINDOWS else (reader,),
            cwd=folder or None,
            start_new_session=not IS_WINDOWS,
        )
    except OSError:
        os.close(alive)
        raise
    finally:
        os.close(reader)
    assert process.stdin is not None
    assert process.stdout is not None
    return DebuggeeProcess(process.stdin, process.stdout, process.pid, alive)
