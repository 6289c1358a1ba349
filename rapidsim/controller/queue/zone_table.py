"""World zones: detection of the TCP, or the arm, entering and leaving a zone.

The motion is sampled every millimetre of its path, however fast it is, and the instant of a
crossing is then found by bisection. Only a crossing of a shorter section of the path is missed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.path_events import AxisRange, Cuboid, Cylinder, Sphere, ZoneShape
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.repeated_rows import divided

LOOK_M = 0.001
_LOOK_S = 0.02
"""Spacing [s] of the first samples; within it samples are evenly spaced."""
_ON_BELT_S = 0.002
"""Spacing [s] of the samples of an arm that follows a belt."""
_COARSE = 2000
"""Maximum number of intervals of a long motion that are first tested for motion of the arm."""
_LOOKS = 1000
"""Number of instants that are sampled in one go."""
_HALVINGS = 40
_MM = 1e-3


@dataclass(slots=True)
class WatchedZone:
    """A zone that is watched."""

    shape: ZoneShape
    crossed: Callable[[bool, float], None]
    """Called with whether the arm is in the zone now, and the time [s]."""
    enabled: bool = True
    inside: bool = False


@dataclass(slots=True)
class WorldZoneTable:
    """The zones that are watched while one robot moves: a `event_source.EventSource`."""

    on_path: ClassVar = True
    unit: MechanicalUnit
    world_from_base: Transform
    limit_s: float
    """Time [s] after which crossings are ignored: a motion may be commanded for days."""
    check_deadline: Callable[[], None]
    """Called while searching for crossings; ends a run that takes too long."""
    _zones: dict[float, WatchedZone] = field(default_factory=dict)
    _looked_to_s: float = 0.0
    _next: tuple[tuple[int, int], float | None, list[WatchedZone]] | None = None
    """Cached next crossing: version of the path, time [s] (None if none), crossed zones."""

    def add(self, zone: WatchedZone, now_s: float) -> float:
        """Watch a zone; report at once if the arm is in it. Returns its number."""
        number = float(max(self._zones, default=0.0) + 1.0)
        self._zones[number] = zone
        self._begin(zone, now_s)
        return number

    def enable(self, number: float, now_s: float, *, enabled: bool) -> None:
        """Switch a zone on or off.

        Raises:
            KeyError: If the zone does not exist.
        """
        zone = self._zones[number]
        if enabled and not zone.enabled:
            zone.enabled = True
            self._begin(zone, now_s)
        elif not enabled and zone.enabled:
            zone.enabled = False
            if zone.inside:
                zone.inside = False
                zone.crossed(False, now_s)

    def free(self, number: float) -> None:
        """Remove a zone.

        Raises:
            KeyError: If the zone does not exist.
        """
        del self._zones[number]
        self._next = None

    @property
    def is_watching(self) -> bool:
        """Whether any zone is on."""
        return any(zone.enabled for zone in self._zones.values())

    def next_s(self) -> float | None:
        """Time [s] at which the arm next enters or leaves a zone, if known; else None."""
        if not self.is_watching:
            return None
        if self._next is None or self._next[0] != self.unit.version:
            preview = self.unit.preview()
            zones = [zone for zone in self._zones.values() if zone.enabled]
            times = [self._crossing(zone, preview) for zone in zones]
            found = min((time_s for time_s in times if time_s is not None), default=None)
            crossed = [zone for zone, time_s in zip(zones, times, strict=True) if time_s == found]
            self._next = (self.unit.version, found, crossed)
        return self._next[1]

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Report the next crossing to its zones; see `event_source.EventSource`."""
        del until_s
        time_s = self.next_s()
        assert time_s is not None
        assert self._next is not None
        crossed = self._next[2]
        self._looked_to_s, self._next = time_s, None
        # Not evaluated again: at the border a single instant is rounded differently from many.
        for zone in crossed:
            zone.inside = not zone.inside
            zone.crossed(zone.inside, max(time_s, passed_s))
        return time_s

    def advance_to(self, time_s: float) -> None:
        """Restrict the search to times after a time [s]."""
        self._looked_to_s = max(time_s, self._looked_to_s)

    def _begin(self, zone: WatchedZone, now_s: float) -> None:
        self._next = None
        self._looked_to_s = max(now_s, self._looked_to_s)
        samples = self.unit.preview().at(np.array([now_s]))
        zone.inside = bool(self._inside(zone, samples)[0])
        if zone.inside:
            zone.crossed(True, now_s)

    def _crossing(self, zone: WatchedZone, preview: Trajectory) -> float | None:
        """Next time [s] at which the arm enters or leaves a zone; None if it does not."""
        looks = _sample_times(preview, self._looked_to_s, min(preview.duration, self.limit_s))
        for begin in range(1, len(looks), _LOOKS):
            self.check_deadline()
            times = looks[begin : begin + _LOOKS]
            changed = np.flatnonzero(self._inside(zone, preview.at(times)) != zone.inside)
            if len(changed):
                break
        else:
            return None
        late = float(times[changed[0]])
        early = float(looks[begin + int(changed[0]) - 1])
        for _ in range(_HALVINGS):
            middle = 0.5 * (early + late)
            if self._inside(zone, preview.at(np.array([middle])))[0] == zone.inside:
                early = middle
            else:
                late = middle
        return late

    def _inside(self, zone: WatchedZone, samples: Samples) -> Array:
        """Whether the arm is in a zone, shape (k,)."""
        shape = zone.shape
        if isinstance(shape.volume, AxisRange):
            within = _axes_within(shape.volume, np.degrees(samples.joints))
        else:
            world_from_tcp = self.world_from_base @ samples.base_from_tcp
            within = _holds(shape.volume, world_from_tcp.translation / _MM)
        result: Array = within != shape.outside
        return result


def _sample_times(preview: Trajectory, start_s: float, end_s: float) -> Array:
    """Times [s] between which the arm makes at most about a millimetre of its path."""
    if end_s <= start_s:
        return np.zeros(0)
    cells = min(int((end_s - start_s) / _LOOK_S) + 1, _COARSE)
    times = np.linspace(start_s, end_s, cells + 1)
    if preview.follows_belts:
        # The arm moves where its path does not.
        return _divided(times, np.ceil(np.diff(times) / _ON_BELT_S))
    # Of robots that move together, the position is no length.
    fastest = preview.fastest_rate(start_s)
    # If the arm hardly moves for long, no samples between are needed.
    ways, widths = fastest * np.diff(preview.place_at(times)), np.diff(times)
    times = _divided(times, np.where(ways > LOOK_M, np.ceil(widths / _LOOK_S), 1))
    return _divided(times, np.ceil(fastest * np.diff(preview.place_at(times)) / LOOK_M))


def _divided(times: Array, counts: Array) -> Array:
    """Times (k,) with each interval divided into counts (k - 1,) parts, at least one."""
    return divided(times, np.maximum(counts, 1).astype(np.int64))


def _holds(volume: Cuboid | Cylinder | Sphere, points: Array) -> Mask:
    """Whether points (k, 3) [mm] of the world are in a volume, shape (k,)."""
    within: Mask
    match volume:
        case Cuboid(low=low, high=high):
            least, most = np.minimum(low, high), np.maximum(low, high)
            within = np.all((points >= least) & (points <= most), axis=1)
        case Cylinder(centre=centre, radius=radius, height=height):
            off = points - np.array(centre)
            above = off[:, 2] * np.sign(height)
            round_it = np.hypot(off[:, 0], off[:, 1]) <= radius
            within = round_it & (above >= 0.0) & (above <= abs(height))
        case Sphere(centre=centre, radius=radius):
            within = np.linalg.norm(points - np.array(centre), axis=1) <= radius
    return within


def _axes_within(volume: AxisRange, joints_deg: Array) -> Mask:
    """Whether joints (k, n) [deg] are between two joint targets, shape (k,)."""
    count = joints_deg.shape[1]
    low, high = np.array(volume.low.robax)[:count], np.array(volume.high.robax)[:count]
    within: Mask = np.all(
        (joints_deg[:, : len(low)] >= low) & (joints_deg[:, : len(low)] <= high), axis=1
    )
    return within
