"""Views of a run: signals over time, the arm at an instant, the values of data."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from rapidsim.analysis.literals import Value
from rapidsim.files import did_you_mean
from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.command import Index
from rapidsim.simulation.results.signal_history import signal_changes
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

T = TypeVar("T")


class Edge(NamedTuple):
    """A signal that changes."""

    time_s: float
    old: float
    new: float


@value_class(frozen=True, slots=True, repr=False)
class SignalHistory:
    """A signal over the whole run."""

    name: str
    times_s: tuple[float, ...]
    """When it takes each value; the first is 0."""
    values: tuple[float, ...]

    def at(self, time_s: float) -> float:
        """Its value at an instant [s]; at a change, the new one."""
        return self.values[max(0, bisect_right(self.times_s, time_s) - 1)]

    @property
    def edges(self) -> tuple[Edge, ...]:
        """Its changes, in order of time."""
        pairs = zip(self.times_s[1:], self.values, self.values[1:], strict=False)
        return tuple(Edge(time_s, old, new) for time_s, old, new in pairs if old != new)

    @property
    def rises_s(self) -> tuple[float, ...]:
        """When it rises [s]."""
        return tuple(edge.time_s for edge in self.edges if edge.new > edge.old)

    @property
    def falls_s(self) -> tuple[float, ...]:
        """When it falls [s]."""
        return tuple(edge.time_s for edge in self.edges if edge.new < edge.old)

    def __repr__(self) -> str:
        """One line."""
        return f"<signal {self.name[:60]}: {len(self.edges)} edges, {self.values[-1]:g} at the end>"


@value_class(frozen=True, slots=True, eq=False, repr=False)
class ArmState:
    """The arm at an instant, or at k of them: then every array has k rows."""

    time_s: float | Array
    joints_deg: Array
    """Shape (n,)."""
    position_mm: Array
    """Shape (3,): the TCP of the active tool in the robot's base frame."""
    quaternion: Array
    """Shape (4,), scalar first."""
    speed_mm_s: float | Array
    """Speed of the TCP relative to the work object."""
    move: int | Index
    """Index of the active move in `run.moves`; while the arm is at rest, of the last one."""

    def __repr__(self) -> str:
        """One line."""
        if np.ndim(self.time_s):
            return f"<arm at {len(self.joints_deg)} instants>"
        x, y, z = self.position_mm
        return f"<arm at {self.time_s:.3f} s: TCP {x:.1f}, {y:.1f}, {z:.1f} mm>"


@value_class(frozen=True, slots=True, eq=False, repr=False)
class ArmMotion:
    """State of one robot at any time of the run."""

    robot_run: RobotRun
    """In m and rad."""
    first_move: int
    """The index of its first move in `run.moves`."""

    @property
    def duration_s(self) -> float:
        """Time [s] at which the arm comes to rest."""
        return self.robot_run.trajectory.duration

    def at(self, time_s: float | Sequence[float] | Array) -> ArmState:
        """The arm at one or several instants [s]; at rest before the start and after the end."""
        many = bool(np.ndim(time_s))
        samples = self.robot_run.sample(np.asarray(time_s, dtype=np.float64))
        rows: int | slice = slice(None) if many else 0
        return ArmState(
            time_s=samples.times if many else float(samples.times[0]),
            joints_deg=np.degrees(samples.joints[rows]),
            position_mm=1000.0 * samples.base_from_tcp.translation[rows],
            quaternion=samples.base_from_tcp.quaternion[rows],
            speed_mm_s=1000.0 * samples.tcp_speed if many else 1000.0 * float(samples.tcp_speed[0]),
            move=samples.move + self.first_move if many else int(samples.move[0]) + self.first_move,
        )

    def __repr__(self) -> str:
        """One line."""
        one = self.robot_run
        return f"<motion of {one.robot.name[:40]} in {one.task[:40]}, {self.duration_s:.3f} s>"


@value_class(frozen=True, slots=True)
class Datum:
    """Data that a module declares, with the value at the end of the run."""

    task: str
    module: str
    name: str
    type: str
    storage: str
    """CONST, PERS or VAR."""
    value: Value


class Named(Mapping[str, T], Generic[T]):
    """A mapping whose names compare without case."""

    def __init__(self, subject: str, items: Mapping[str, T], more: Mapping[str, T] | None = None):
        """Keep items under the names as they are written.

        Args:
            subject: They are, for messages.
            items: By name.
            more: Names that mean something, too, and are not listed.
        """
        self._what = subject
        self._items = dict(items)
        self._by_key = {name.lower(): item for name, item in {**(more or {}), **items}.items()}

    def __getitem__(self, name: str) -> T:
        """Return the item of a name.

        Raises:
            KeyError: If no item has the name; the message suggests the nearest.
        """
        try:
            return self._by_key[name.lower()]
        except KeyError:
            cure = did_you_mean(name, self._items)
            raise KeyError(f"no {self._what} `{name}`{f'; {cure}' if cure else ''}") from None

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter(self._items)

    def __len__(self) -> int:
        """Number of items."""
        return len(self._items)

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self)} {self._what}s>"


def data_by_name(data: Sequence[Datum]) -> Named[Value]:
    """The values of data by name.

    Each is there as `Task/Module/name`; as `Module/name` and as `name`, too, where all data that
    are called so have the same value. Listed are the shortest names.
    """
    means: dict[str, list[Value]] = {}
    for one in data:
        for name in _names(one):
            means.setdefault(name.lower(), []).append(one.value)
    shortest: dict[str, Value] = {}
    others: dict[str, Value] = {}
    for one in data:
        clear = [name for name in _names(one) if _all_same(means[name.lower()])]
        shortest.setdefault(clear[0], one.value)
        others.update(dict.fromkeys(clear, one.value))
    return Named("value", shortest, others)


def _names(datum: Datum) -> tuple[str, ...]:
    return datum.name, f"{datum.module}/{datum.name}", f"{datum.task}/{datum.module}/{datum.name}"


def _all_same(values: Sequence[Value]) -> bool:
    return all(value == values[0] for value in values)


def signals_by_name(simulation: Simulation) -> Named[SignalHistory]:
    """Every signal that is declared or set."""
    histories = {
        name: SignalHistory(name, *zip(*changes, strict=True))
        for name, changes in signal_changes(simulation, still=True).items()
    }
    return Named("signal", histories)
