"""The settings of `rapidsim serve`, apart from its program."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from ssl import SSLContext
from types import MappingProxyType
from typing import Final

from rapidsim.egm.devices import Address
from rapidsim.simulation.live.states import Motors, OperatingMode
from rapidsim.values import value_class

DEFAULT_USERS: Final[Mapping[str, str]] = MappingProxyType(
    dict.fromkeys(("Default User", "Admin", "admin"), "robotics")
)
"""Default users on this computer, as on a controller."""
NO_LATENCIES: Final[Mapping[str, float]] = MappingProxyType({})
LATENCIES: Final[Mapping[str, Mapping[str, float]]] = MappingProxyType(
    {"irc5": MappingProxyType({"start": 10.0, "loadmod": 13.0})}
)
"""Wall-clock times [s] until a real controller has answered an operation, by controller."""


@value_class(frozen=True, slots=True, kw_only=True)
class EngineSettings:
    """Initial state and pace of the controller."""

    speed: float | None = 1.0
    """Virtual seconds per second of the wall clock; None for as fast as possible."""
    request_s: float | None = None
    """The virtual time [s] that passes before each request in lock-step; None for no lock-step."""
    motors: Motors = Motors.ON
    mode: OperatingMode = OperatingMode.AUTO
    robotware: int | None = None
    """Version to report: 6, 7 or 8; None for that of the station."""
    hosts: frozenset[str] = frozenset()
    """Other hosts that programs' sockets may bind or connect to."""
    sensors: tuple[tuple[str, Address], ...] = ()
    """Devices of sensors that guide robots, and their addresses."""
    any_sensor_port: bool = False
    """Whether sensors may answer from any port of their computer."""
    journal: Path | None = None
    """File of the journal; None for no journal."""
    record: Path | None = None
    """File of the recording, which grows during the run; None for no recording."""
    view: bool = False
    """Whether a viewer shows the recording while it grows."""


@value_class(frozen=True, slots=True, kw_only=True)
class ServerSettings:
    """Addresses and users."""

    host: str = "127.0.0.1"
    hosts: frozenset[str] = frozenset()
    """Further names under which clients address it, in lower case."""
    origins: frozenset[str] = frozenset()
    """Origins of pages of others that may use it, in lower case."""
    rws1_port: int | None = 8080
    """Port of Robot Web Services 1.0; 0 for a free one, None to disable it."""
    rws2_port: int | None = None
    """Port of Robot Web Services 2.0; 0 for a free one, None to disable it."""
    faults_port: int | None = None
    """Port of this computer for tests that make the controller fail; None for no such port."""
    tls: SSLContext | None = None
    """Key and certificate of Robot Web Services 2.0."""
    users: Mapping[str, str] = field(default_factory=lambda: DEFAULT_USERS)
    latencies_s: Mapping[str, float] = field(default_factory=lambda: NO_LATENCIES)
    """Wall-clock time [s] until an operation is answered, by its name; see `LATENCIES`."""
    most_sessions: int = 70
    session_timeout_s: float = 300.0
