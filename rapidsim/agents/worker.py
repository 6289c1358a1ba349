"""The process that works on the programs of agents, whose memory is limited on Linux.

A program that needs more ends this process or its own call, never the server.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process
from pathlib import Path
from threading import Lock, Thread
from typing import TypeVar

from rapidsim.files import InputError

T = TypeVar("T")
MOST_BYTES = 2_000_000_000
"""Memory of a program, beyond that of the process at its start."""


class Worker:
    """A process that answers one call at a time; started when it is first needed."""

    def __init__(self, most_bytes: int = MOST_BYTES) -> None:
        """Start nothing.

        Args:
            most_bytes: Memory that the process may use beyond that at its start.
        """
        self._most_bytes = most_bytes
        self._turn = Lock()
        self._pool: ProcessPoolExecutor | None = None
        self._folder = tempfile.TemporaryDirectory(prefix="rapidsim-agents-")

    def call(self, tool: Callable[..., T], *arguments: object, **named: object) -> T:
        """Return the result of a tool, a function of a module.

        Raises:
            InputError: If the tool raises it, or the process is out of memory or killed.
        """
        with self._turn:
            is_new = self._pool is None
            if self._pool is None:
                self._pool = ProcessPoolExecutor(
                    1, get_context("spawn"), _begin, (self._most_bytes, self._folder.name)
                )
            try:
                return self._pool.submit(tool, *arguments, **named).result()
            except (MemoryError, BrokenProcessPool):
                self.close()
        if not is_new:
            # Results of earlier programs may have occupied the memory.
            return self.call(tool, *arguments, **named)
        raise InputError(
            f"the program needs more than {self._most_bytes / 1e9:g} GB of memory, or its process "
            "was killed",
            "send a smaller program, or one with smaller arrays",
        )

    def close(self) -> None:
        """End the process, and delete the files of a call that it did not finish."""
        if self._pool is not None:
            self._pool.shutdown()
            self._pool = None
        self._folder.cleanup()
        self._folder = tempfile.TemporaryDirectory(prefix="rapidsim-agents-")


def _begin(most_bytes: int, folder: str) -> None:
    """Prepare the process: it ends with the server, and its memory and files are limited."""
    Thread(target=_end_with_server, daemon=True).start()
    tempfile.tempdir = folder
    # The memory of what all programs need is no program's.
    import rapidsim.agents.program_tools  # noqa: F401, PLC0415

    if sys.platform == "linux":
        import resource  # noqa: PLC0415

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        limit = pages * resource.getpagesize() + most_bytes
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def _end_with_server() -> None:
    server = parent_process()
    if server is not None:
        server.join()
        os._exit(1)
