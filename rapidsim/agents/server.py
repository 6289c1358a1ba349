"""The tools over the Model Context Protocol; the only module that imports its SDK."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import wraps
from types import MappingProxyType
from typing import Any

from mcp.server.mcpserver import Image, MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.types import ToolAnnotations

from rapidsim import __version__
from rapidsim.agents import knowledge_tools, picture_tools, program_tools, records
from rapidsim.agents.paging import Answer
from rapidsim.agents.worker import Worker
from rapidsim.files import InputError

_INSTRUCTIONS = (
    "Tools for RAPID, the language of ABB robots. Write a program, `check` it, let `fix` correct "
    "what it can, `check` again, then `run` it. Texts are sent with each call; nothing is kept. "
    "Everything that is unknown fails (`strict`). `next_cursor` asks for the rest of a long answer."
)
_TOOLS: Mapping[str, tuple[Callable[..., Answer], type]] = MappingProxyType(
    {
        "check": (program_tools.check, records.CheckAnswer),
        "run": (program_tools.run, records.RunToolAnswer),
        "fix": (program_tools.fix, records.FixAnswer),
        "diff": (program_tools.diff, records.DiffAnswer),
        "reach": (knowledge_tools.reach, records.ReachAnswer),
        "explain": (knowledge_tools.explain, records.ExplainAnswer),
        "signature": (knowledge_tools.signature, records.RoutineAnswer),
        "search_library": (knowledge_tools.search_library, records.SearchAnswer),
    }
)
"""Tools with the records of their answers."""


_ANNOTATIONS = ToolAnnotations(
    read_only_hint=True, destructive_hint=False, idempotent_hint=True, open_world_hint=False
)


def serve() -> None:
    """Serve the tools on standard input and output until the client ends."""
    server = MCPServer("rapidsim", instructions=_INSTRUCTIONS, version=__version__)
    worker = Worker()
    for name, (tool, record) in _TOOLS.items():
        server.tool(name=name, description=tool.__doc__, annotations=_ANNOTATIONS)(
            _guarded(tool, record, worker)
        )

    @server.tool(annotations=_ANNOTATIONS)
    def path_picture(
        files: dict[str, str], robot: str | None = None, station: str | None = None
    ) -> Image:
        """Run a program and draw the path of its TCP."""
        try:
            png = worker.call(picture_tools.path_picture, files, robot, station)
        except InputError as error:
            raise ToolError(error.message) from None
        return Image(data=png, format="png")

    try:
        server.run("stdio")
    finally:
        worker.close()


def _guarded(tool: Callable[..., Answer], record: type, worker: Worker) -> Callable[..., Any]:
    """Return a tool of the worker that answers with the error if its input cannot be used."""

    @wraps(tool)
    def call(*arguments: Any, **named: Any) -> Any:
        try:
            return worker.call(tool, *arguments, **named)
        except InputError as error:
            return {
                "error": {
                    "message": error.message,
                    "help": error.help,
                    "similar": list(error.similar),
                }
            }

    # The output schema is made from the annotation.
    call.__annotations__ = {**tool.__annotations__, "return": record}
    return call
