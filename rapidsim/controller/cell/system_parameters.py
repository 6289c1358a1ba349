"""The system parameters of a run: those of the station with the program's changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rapidsim.language.equipment import Attributes, Configured


class SystemParameters:
    """A copy that the program may change; a controller applies changes when it is restarted."""

    def __init__(self, configured: Configured) -> None:
        """Start with the parameters of the station."""
        self._types = {
            (domain.upper(), of.upper()): [Attributes(one) for one in found]
            for domain, types in configured.items()
            for of, found in types.items()
        }

    @property
    def domains(self) -> tuple[str, ...]:
        """All domains."""
        return tuple(dict.fromkeys(domain for domain, _ in self._types))

    def types(self, domain: str) -> tuple[str, ...]:
        """The types of a domain; empty if there is no such domain."""
        return tuple(of for one, of in self._types if one == domain.upper())

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        """The instances of a type; None if there is no such type."""
        return self._types.get((domain.upper(), of.upper()))

    def change(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        """Set an attribute of an instance, by its position."""
        instances = self._types[domain.upper(), of.upper()]
        instances[number] = instances[number].with_value(attribute, value)
