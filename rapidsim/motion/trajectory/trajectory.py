"""Motion of a whole run as a function of time, during the run and afterwards.

A controller smooths its command (`command`): the visible position is the mean of the commanded
position over a time window (`filter_windows`), which ends now and is as wide as the filter time.
The arm therefore stays exactly on its path and lags behind the command. If each axis is smoothed
separately instead, the joints are the means of the commanded ones (`axis_smoothing`), and the
visible position is only the progress of the arm along its path.

No value is sampled or interpolated: within a cell of a timing S is a parabola of time and its mean
a cubic, and joints are solved for the exact pose.

While the robot is guided by a sensor there is no path: joints are those of a `GuidedSection`. If a
sensor corrects the path, the arm follows it with an offset: a `CorrectedSection`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple, overload

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.belts import BeltRide
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import Averages, Smoothing
from rapidsim.motion.trajectory.axis_smoothing import mean_joints
from rapidsim.motion.trajectory.command import ROUNDING_M, Index, MotionCommand, Piece
from rapidsim.motion.trajectory.corrected_section import CorrectedSection
from rapidsim.motion.trajectory.filter_windows import Windows
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.ramps import RampedCommand
from rapidsim.motion.trajectory.samples import JointSamples, Samples, guide, lead, move_arm
from rapidsim.motion.trajectory.zero_crossings import first_crossing_by_slope
from rapidsim.values import value_class

SAMPLE_STEP_S = 0.012
"""Interval [s] at which ABB's controllers log positions."""
_SAMPLES_AT_ONCE = 10_000
_PLACES_AT_ONCE = 2_000
"""Number of places for which paths and timings are joined, not all of a long run."""
_ROUNDING_S = 1e-11
_NO_TRAVEL_M = 1e-6
_NO_WAY = 1e-9
"""TCP travel per path length [m/m] below which a path only turns the tool."""
_CHORD_S = 0.004
"""Length [s] of the chords along which the travel of a guided arm is measured."""
_NEAR_S = 1e-10
"""Difference [s] between times that the digits of a position can just distinguish."""


class Mark(NamedTuple):
    """A position of the visible motion, from which travel is counted."""

    time_s: float
    place_m: float
    """Position S [m] of the run."""


@value_class(frozen=True, slots=True)
class _Guided:
    section: GuidedSection
    until_s: float = np.inf
    """Start [s] of the next move; until then the arm rests at the end of the section."""


class Trajectory:
    """Position of the arm at any time; it can only be extended."""

    def __init__(
        self,
        start: Waypoint,
        filter_time: float = 0.0,
        smoothing: Smoothing = "path",
        averages: Averages = 1,
    ) -> None:
        """Start at rest.

        Args:
            start: Initial position of the arm.
            filter_time: Width [s] of the smoothing; 0 switches it off.
            smoothing: Smoothed quantity; see `MotionModel`.
            averages: Number of moving averages; see `MotionModel`.
        """
        self._start = start
        self._smoothing = smoothing
        self._windows = Windows(filter_time, averages)
        self._ramped = RampedCommand()
        self._guided: list[_Guided] = []
        self._corrected: list[CorrectedSection] = []
        self._follows_belts = False

    def begin_at(self, start: Waypoint) -> None:
        """Rest at another start position; for an arm that has not moved."""
        assert not self.duration
        self._start = start

    @property
    def guided(self) -> tuple[GuidedSection, ...]:
        """Sections in which the robot was guided by a sensor, in order of time."""
        return tuple(one.section for one in self._guided)

    def guide(self, section: GuidedSection) -> None:
        """Start guidance of a robot at rest; the next piece begins where the guidance ends."""
        if self._guided:
            self._guided[-1] = replace(self._guided[-1], until_s=section.start_s)
        self._guided.append(_Guided(section))

    def withdraw_guidance(self) -> None:
        """Discard the last guidance, which has not begun: the robot rests where it was before."""
        *before, _ = self._guided
        self._guided = [*before[:-1], *(replace(one, until_s=np.inf) for one in before[-1:])]

    def correct(self, section: CorrectedSection) -> None:
        """Add an offset to the arm's path from now on."""
        self._corrected.append(section)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Pieces as planned, without ramps, in order of time."""
        return self._ramped.planned.pieces

    @property
    def command(self) -> MotionCommand:
        """The command that is smoothed."""
        return self._ramped.command

    def append(self, piece: Piece) -> float:
        """Add a piece after the last one.

        Returns:
            Position S [m] of the whole run at the start of the piece: S - `from_s` converts
            positions on its path to positions of the run.

        Raises:
            ValueError: If the piece starts before the last one ends, or ends before it starts.
        """
        elsewhere = self._has_ridden_on(piece)
        self._follows_belts = self._follows_belts or piece.path.belts is not None
        if self._guided:
            last = self._guided[-1]
            elsewhere |= bool(np.isinf(last.until_s))
            self._guided[-1] = replace(last, until_s=min(last.until_s, piece.start_time))
        if elsewhere:
            filter_time = self._windows.filter_time
            self._windows.begin(piece.start_time, filter_time, elsewhere=True)
        return self._ramped.append(piece, elsewhere=elsewhere)

    def _has_ridden_on(self, piece: Piece) -> bool:
        """Whether a belt has taken the arm elsewhere before a piece on it begins."""
        if piece.path.belts is None or not self._follows_belts:
            return False
        last = self.pieces[-1]
        if last.path.belts is None:
            return False
        ends = (last.path, last.to_s), (piece.path, piece.from_s)
        before, now = (float(path.joints_at(np.array([s]))[0, -1]) for path, s in ends)
        return abs(now - before) > _NO_TRAVEL_M

    def cut(self, time_s: float) -> None:
        """Remove the command after a time [s]."""
        self._windows.cut(time_s)
        self._ramped.cut(time_s)
        if self._guided and time_s <= self._guided[-1].until_s:
            self._guided[-1] = replace(self._guided[-1], until_s=np.inf)

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need."""
        # In a time of rest the path is that at the end of the command; sensors may still guide.
        seen_s = min(before_s, self.command_end) - self._windows.widest
        self._windows.forget(seen_s)
        self._ramped.forget(seen_s)
        self._guided = [one for one in self._guided if one.until_s >= before_s]
        self._corrected = [one for one in self._corrected if one.until_s >= before_s]
        for guided in self._guided:
            guided.section.forget(before_s)
        for corrected in self._corrected:
            corrected.forget(before_s)

    def extended(self, piece: Piece) -> Trajectory:
        """Return a copy with one more piece; this trajectory is unchanged."""
        longer = Trajectory(self._start, smoothing=self._smoothing)
        longer._windows, longer._ramped = self._windows.copy(), self._ramped.copy()
        longer._guided, longer._corrected = self._guided.copy(), self._corrected
        longer._follows_belts = self._follows_belts
        longer.append(piece)
        return longer

    @property
    def command_end(self) -> float:
        """End of the planned command [s]; 0 without pieces."""
        return self._ramped.planned.end

    @property
    def duration(self) -> float:
        """Last instant [s] of visible motion; 0 without pieces."""
        planned_s = self.seen_s(self.command_end) if self._ramped.planned.last_row else 0.0
        led_s = (one[-1].end_s for one in (self.guided, self._corrected) if one)
        return max(planned_s, *led_s, 0.0)

    def seen_s(self, command_s: float) -> float:
        """Return the time [s] at which the visible motion completes the command up to a time."""
        return command_s + self.lag_s(command_s)

    def lag_s(self, command_s: float) -> float:
        """Return the delay [s] of the visible motion after that time."""
        ramp_s = self._ramped.lag_s(command_s)
        return ramp_s + self._windows.lag(command_s + ramp_s)

    @property
    def follows_belts(self) -> bool:
        """Whether the arm follows a belt anywhere."""
        return self._follows_belts

    def riding(self) -> tuple[tuple[BeltRide, ...], float]:
        """Return the belts that the arm follows at the end of its command, and their axis [m]."""
        if not self._follows_belts or self.pieces[-1].path.belts is None:
            return (), 0.0
        last = self.pieces[-1]
        end = np.array([last.to_s])
        belts = last.path.belts
        assert belts is not None
        riding = belts.riding(int(last.path.segment_at(end)[0]), last.to_s)
        return riding, float(last.path.joints_at(end)[0, -1]) if riding else 0.0

    @property
    def has_ramps(self) -> bool:
        """Whether a ramp of AccSet acts anywhere."""
        return self._ramped.has_ramps

    @property
    def length(self) -> float:
        """Position S [m] of the run at the end of the last piece."""
        return self._ramped.planned.length

    @property
    def travelled_m(self) -> float:
        """TCP travel [m] of the whole run, with corners cut."""
        row = np.arange(1, self.command.last_row + 1)
        return self._travelled(row, np.zeros(len(row)), self.command.increases(row))

    def _travelled(self, row: Index, since: Array, until: Array) -> float:
        """Return the TCP travel [m] on the paths of rows (k,), from distances in them to others."""
        travel = np.empty(2 * len(row))
        for path, s, at, _ in self.command.on_paths(np.tile(row, 2), np.append(since, until)):
            travel[at] = path.travelled(s)
        begin, end = np.split(travel, 2)
        return float(np.sum(end - begin))

    def mark(self, time_s: float) -> Mark:
        """Return the mark of a time [s]: a place, for a move may begin before it is issued."""
        if not self.command.last_row:
            return Mark(time_s, 0.0)
        return Mark(time_s, float(self.place_at(np.array([time_s]))[0]))

    def travelled_between(self, first: Mark, last: Mark) -> float:
        """Return the TCP travel [m] of the visible motion from one mark to a later one.

        Guidance and corrections by a sensor are measured along chords of `_CHORD_S`.
        """
        ends_s = [one.until_s for one in self._guided] + [one.until_s for one in self._corrected]
        if self._follows_belts or any(end_s > first.time_s for end_s in ends_s):
            steps = max(1, math.ceil((last.time_s - first.time_s) / _CHORD_S))
            samples = self.at(np.linspace(first.time_s, last.time_s, steps + 1))
            chords = np.diff(samples.base_from_tcp.translation, axis=0)
            # A change of tool changes the TCP, which is not travel.
            same = np.diff(samples.move) == 0
            return float(np.sum(np.linalg.norm(chords[same], axis=1)))
        if last.place_m <= first.place_m:
            return 0.0
        places = np.array([first.place_m, last.place_m])
        (begin, end), (since_m, until_m) = self.command.rows_at(places)
        row = np.arange(begin, end + 1)
        until, since = self.command.increases(row), np.zeros(len(row))
        until[-1], since[0] = until_m, since_m
        return self._travelled(row, since, until)

    def at(self, times: Array, *, coarse: bool = False) -> Samples:
        """Return the arm at some instants (k,) [s], in any order.

        With `coarse`, axes are within 1e-6 rad or m in half of the time (short moves: a quarter).
        """
        times = np.atleast_1d(np.asarray(times, dtype=np.float64))
        # Where a belt has taken the arm elsewhere, parts of equal width would span the jump.
        coarse = coarse and not self._follows_belts
        samples = self._planned(times, coarse) if self.command.last_row else self._standing(times)
        for led in self._corrected:
            beside = (led.start_s <= times) & (times < led.until_s)
            if beside.any():
                lead(samples, led, beside)
        for stretch, held in self._guided_sections(times):
            guide(samples, stretch, held)
        return samples

    def postures(self, times: Array) -> JointSamples:
        """Return the axes at some instants (k,) [s], in any order, as accurate as a coarse `at`."""
        if not self.command.last_row or not self._by_axes or self._corrected or self.follows_belts:
            samples = self.at(times)
            return JointSamples(samples.move, samples.joints, samples.external)
        row, way, _ = self._visible(times)
        joints, _ = mean_joints(self.command, self._windows, times, coarse=True)
        move = np.empty(len(times), dtype=np.int64)
        for path, s, at, first in self.command.on_paths(row, way):
            move[at] = first + path.segment_at(s)
        arm, external = np.split(joints, [len(self._start.joints)], axis=1)
        external = external[:, : self._external_count]
        for stretch, held in self._guided_sections(times):
            arm[held], external[held] = stretch.joints_at(times[held]), stretch.external
        return JointSamples(move, arm, external)

    @property
    def _by_axes(self) -> bool:
        return self._smoothing == "axes" and self._windows.filter_time > 0.0

    def _guided_sections(self, times: Array) -> Iterator[tuple[GuidedSection, Mask]]:
        """Yield guided sections that determine some instants (k,) [s], with a mask of these."""
        for one in self._guided:
            held = (one.section.start_s <= times) & (times <= one.until_s)
            if held.any():
                yield one.section, held

    def _planned(self, times: Array, coarse: bool) -> Samples:
        """Return the arm on its path."""
        row, way, speed = self._visible(times)
        by_axes = self._by_axes
        joints = np.empty((len(times), self.command.axis_count))
        rates, offsets = np.empty(0), None
        if by_axes:
            joints, rates = mean_joints(self.command, self._windows, times, coarse=coarse)
        pose = Transform(np.empty((len(times), 3, 3)), np.empty((len(times), 3)))
        move, tcp_speed = np.empty(len(times), dtype=np.int64), np.empty(len(times))
        # Before the first piece the arm is at its start, with its tool.
        for path, s, at, first in self.command.on_paths(row, way):
            if by_axes:
                own = slice(path.axis_count)
                tcp, segment, tcp_speed[at] = path.nearby_state(
                    s, joints[at, own], rates[at, own], speed[at]
                )
            else:
                points = path.evaluate(s)
                joints[at, : path.axis_count] = np.concatenate(
                    [points.joints, points.external], axis=1
                )
                tcp, segment = points.base_from_tcp, points.segment
                tcp_speed[at] = points.tcp_rate * speed[at]
            pose.rotation[at], pose.translation[at] = tcp.rotation, tcp.translation
            move[at] = first + segment
            if path.belts is not None:
                offsets = np.zeros((len(times), 3)) if offsets is None else offsets
                axis = joints[at, path.axis_count - 1]
                offsets[at] = path.belts.at(segment, s, axis, times[at])
        arm, external = np.split(joints, [len(self._start.joints)], axis=1)
        samples = Samples(times, move, arm, pose, tcp_speed, external[:, : self._external_count])
        return samples if offsets is None else move_arm(samples, path.kinematics, offsets)

    @property
    def _external_count(self) -> int:
        """Number of external axes; axes of carriers, which follow them, are no samples."""
        return len(self._start.external)

    def directions(self, times: Array) -> Array:
        """Return directions (k, 3) of the path at instants (k,) [s], in base; 0 if it has none.

        For an arm at rest: the direction of the path that ended there, or begins there.
        """
        ways = np.zeros((len(times), 3))
        if not self.command.last_row:
            return ways
        row, way, _ = self._visible(times)
        for path, s, at, _ in self.command.on_paths(row, way):
            ways[at] = path.tcp_derivatives(s, path.layout.piece_at(s))[0]
        length = np.linalg.norm(ways, axis=1, keepdims=True)
        unit: Array = np.divide(ways, length, out=np.zeros_like(ways), where=length > _NO_WAY)
        return unit

    def off_path(self, samples: Samples) -> Array:
        """Return distances (k,) [m] of sampled TCPs from the motion with path smoothing.

        Zero if the motion is smoothed like that; else a lower bound of the distance from the
        commanded path.
        """
        off = np.zeros(len(samples.times))
        if self._smoothing == "path" or not self.command.last_row:
            return off
        row, way, _ = self._visible(samples.times)
        for path, s, at, _ in self.command.on_paths(row, way):
            points = path.evaluate(s)
            on_path = points.base_from_tcp.translation
            if path.belts is not None:
                axis = points.external[:, -1]
                on_path = on_path + path.belts.at(points.segment, s, axis, samples.times[at])
            off[at] = np.linalg.norm(samples.base_from_tcp.translation[at] - on_path, axis=1)
        for _, held in self._guided_sections(samples.times):
            off[held] = 0.0
        return off

    def _standing(self, times: Array) -> Samples:
        """Return the arm at its start."""
        count, pose = len(times), self._start.base_from_tcp
        return Samples(
            times,
            np.zeros(count, dtype=np.int64),
            np.tile(self._start.joints, (count, 1)),
            Transform(np.tile(pose.rotation, (count, 1, 1)), np.tile(pose.translation, (count, 1))),
            np.zeros(count),
            np.tile(self._start.external, (count, 1)),
        )

    @property
    def times(self) -> Array:
        """Instants (k,) [s] every `SAMPLE_STEP_S` from 0, and the end of visible motion."""
        steps: Array = np.arange(0.0, self.duration, SAMPLE_STEP_S)
        return np.append(steps, self.duration)

    @property
    def joints(self) -> Array:
        """Joints (k, n) [rad] at `times`, computed at each access; `at` also returns poses."""
        times = self.times
        # In chunks, so that a long run does not need memory for all its solutions at once.
        parts = np.array_split(times, len(times) // _SAMPLES_AT_ONCE + 1)
        return np.concatenate([self.at(part).joints for part in parts])

    def place_at(self, times: Array) -> Array:
        """Return the visible position S (k,) [m] of the run at times (k,) [s]."""
        return self._progress(np.atleast_1d(np.asarray(times, dtype=np.float64)))[0]

    def _progress(self, times: Array) -> tuple[Array, Array]:
        """Return the visible position S (k,) [m] and speed dS/dt (k,) [m/s] at times (k,) [s]."""
        row, way, speed = self._visible(times)
        return self.command.starts(row)[1] + way, speed

    def fastest_rate(self, start_s: float) -> float:
        """Return the upper bound of the TCP travel per change of S from a time [s] on."""
        seen_s, fastest = start_s - self._windows.widest - self._ramped.widest, 1.0
        for piece in reversed(self.pieces):
            fastest = max(fastest, piece.path.fastest_rate)
            if piece.start_time < seen_s:
                break
        return fastest

    def speed_at(self, times: Array) -> Array:
        """Return the visible speed dS/dt (k,) [m/s] along the path at times (k,) [s]."""
        return self._visible(times)[2]

    @overload
    def time_at_place(self, place: float) -> float: ...

    @overload
    def time_at_place(self, place: Array) -> Array: ...

    def time_at_place(self, place: float | Array) -> float | Array:
        """Return the first time [s] at which the visible motion is at positions S [m] of the run.

        Args:
            place: One position, or positions (k,).
        """
        places = np.atleast_1d(np.asarray(place, dtype=np.float64))
        parts = np.array_split(places, len(places) // _PLACES_AT_ONCE + 1)
        times = np.concatenate(list(map(self._times_at, parts)))
        return times if np.ndim(place) else float(times[0])

    def _times_at(self, places: Array) -> Array:
        """Return the first times (k,) [s] of the visible motion at positions S (k,) [m]."""
        times = self.command.time_at(places)
        if self._windows.filter_time > 0.0:
            # The mean over a window passes a position after the command has.
            wanted, late = places - ROUNDING_M, times + self._windows.widest
            times = first_crossing_by_slope(self._progress, wanted, times, late, within=_NEAR_S)
        return times

    def _visible(self, times: Array) -> tuple[Index, Array, Array]:
        """Return row (k,), distance (k,) [m] since its start, and speed dS/dt (k,) [m/s]."""
        command, windows = self.command, self._windows
        if len(times) > _PLACES_AT_ONCE:
            parts = np.array_split(times, len(times) // _PLACES_AT_ONCE + 1)
            rows, ways, rates = map(np.concatenate, zip(*map(self._visible, parts), strict=True))
            return rows, ways, rates
        if windows.filter_time == 0.0:
            row = command.row_at(times)
            return row, command.state(row, times)[0], command.speed(row, times)
        width, rate, floor = windows.at(times)
        before = np.maximum(times - width, floor)
        instants = windows.instants(times, width, before)
        oldest, way, changes = command.since(before, instants)
        mean, speed = windows.mean(width, rate, changes)
        return *self._row_of(oldest, way + mean), speed

    def _row_of(self, oldest: Index, arc_length: Array) -> tuple[Index, Array]:
        """Convert distances (k,) [m] counted from rows (k,) to the rows that contain them."""
        row, arc_length = oldest.copy(), np.maximum(arc_length, 0.0)
        while True:
            whole = self.command.increases(row)
            past = np.flatnonzero((arc_length > whole + ROUNDING_M) & (row < self.command.last_row))
            if not len(past):
                return row, np.minimum(arc_length, whole)
            arc_length[past] -= whole[past]
            row[past] = np.minimum(self.command.following(row[past]), self.command.last_row)
