"""One resource of Robot Web Services: its address and the function that answers.

An address is split at its slashes; `{name}` matches one part, `{name...}` all remaining parts
except the parts that follow it. Names are case-sensitive.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rapidsim.server.resources.context import Resource


@dataclass(frozen=True)
class Route:
    """A resource with its method and action, and the function that answers it."""

    method: str
    address: str
    resource: Resource
    action: str = ""

    @cached_property
    def parts(self) -> tuple[str, ...]:
        """Parts of the address."""
        return tuple(self.address.split("/"))

    def matched(self, parts: list[str]) -> dict[str, str] | None:
        """Return the parameters of an address; None if it does not match."""
        found: dict[str, str] = {}
        for index, part in enumerate(self.parts):
            if part.endswith("...}"):
                after = self.parts[index + 1 :]
                end = len(parts) - len(after)
                if end <= index or tuple(parts[end:]) != after:
                    return None
                return {**found, part[1:-4]: "/".join(parts[index:end])}
            if index >= len(parts):
                return None
            if part.startswith("{"):
                found[part[1:-1]] = parts[index]
            elif part.startswith("$"):
                if not parts[index].startswith("$"):
                    return None
                found[part[2:-1]] = parts[index][1:]
            elif part != parts[index]:
                return None
        return found if len(parts) == len(self.parts) else None
