"""Externally guided motion of one task: identities, and the robot in the hand of a sensor.

A guidance goes on by a cycle at a time, whatever the program does meanwhile, and takes what the
sensor has said at instants of virtual time. Who the sensor is, `cell.sensors` knows.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar, Final

import numpy as np

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.sensors import Sensor, Teller
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import frames_of, pose_aim
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.findings.guidance import NobodyGuides
from rapidsim.frames.transform import Array
from rapidsim.language.data import UNUSED_AXIS, EgmMinMax, ExtJoint
from rapidsim.language.error_numbers import ERR_UDPUC_COMM, rapid_error
from rapidsim.language.errors import NotAllowed, RapidError
from rapidsim.language.guidance import (
    CONNECTED,
    DISCONNECTED,
    RUNNING,
    Activation,
    GuidanceTerms,
    Purpose,
    SensorSetup,
)
from rapidsim.motion.guidance.aims import Aim, Band, JointAim
from rapidsim.motion.guidance.feedback import GuidedFeedback
from rapidsim.motion.guidance.guided_run import Ended, GuidedRun, Terms
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.guided_stretch import GuidedStretch

MOST_IDENTITIES: Final = 4
"""So many a task may have at one time; from memory of ABB's documents."""
DEFAULT_BAND: Final = EgmMinMax(-0.5, 0.5)
r"""What \J1 and its like are where nobody says: so near [deg, mm] the robot is there."""
_ROUNDING = 1e-6


@dataclass(frozen=True, slots=True)
class ExternalMotionData:
    """A configuration of the type External Motion Interface Data."""

    filters: bool
    """Level 1 and 2 have a filter of the controller's own; level 0 has none."""
    gain: float
    """Kp [1/s]."""
    bandwidth_hz: float


DEFAULT_DATA: Final = ExternalMotionData(filters=True, gain=5.0, bandwidth_hz=20.0)
"""That of the name `default`, which every controller has; from memory of ABB's documents."""


@dataclass(slots=True, eq=False)
class _Identity:
    state: float = DISCONNECTED
    setup: SensorSetup | None = None
    data: ExternalMotionData = DEFAULT_DATA
    sensor: Sensor | None = None
    activation: Activation | None = None


@dataclass(slots=True, eq=False)
class _UnderWay:
    """A guidance; implements `solo_queue.GuidedMotion`."""

    identity: _Identity
    run: GuidedRun
    told: Teller
    stretch: GuidedStretch
    waits: bool
    cycles: int = 0

    @property
    def next_s(self) -> float:
        """Of its next cycle [s]."""
        return self.told.first_s + self.cycles * CYCLE_S

    def step(self, answer: SensorAnswer | None) -> None:
        """Go on by a cycle."""
        self.cycles += 1
        self.run.step(answer)
        self.stretch.append(self.run.motion.joints, self.run.motion.speed)

    def let_go(self) -> None:
        """The robot brakes and stands; nobody guides it any more."""
        self.run.stop(goes_back=False, ramp_out_s=0.0)
        self.run.give_up_way_back()
        while not self.run.is_over:
            self.step(None)


@dataclass(slots=True, eq=False)
class TaskGuidance:
    """Implements `language.guidance.Guidance`; its cycles are a `clock.Happening`."""

    on_path: ClassVar = False
    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    state_of_motion: MotionState
    journal: Journal
    limits: Callable[[], Limits]
    _identities: dict[int, _Identity] = field(default_factory=dict)
    _under_way: _UnderWay | None = None
    _last: tuple[_Identity, Ended] | None = None
    """Whose guidance has ended last, and how, until somebody has asked."""

    # What a program asks.

    def connect(self) -> int:
        """A new identity."""
        number = next(n for n in range(1, MOST_IDENTITIES + 2) if n not in self._identities)
        if number > MOST_IDENTITIES:
            raise NotAllowed(
                f"EGMGetId: all {MOST_IDENTITIES} identities of the task are used; EGMReset first"
            )
        self._identities[number] = _Identity()
        return number

    def set_up(self, identity: int, setup: SensorSetup) -> None:
        """Connect an identity with a sensor."""
        one = self._of(identity)
        if one.state == RUNNING:
            raise NotAllowed("EGMSetupUC: the sensor guides the robot; EGMStop ends that")
        self.clock.come_up()
        data = self._data(setup.configuration)
        self._close(one)
        one.setup, one.data, one.activation = setup, data, None
        one.sensor, one.state = self.cell.sensors.open(setup.device), CONNECTED

    def activate(self, identity: int, activation: Activation) -> None:
        """Say what the sensor's goals mean."""
        purpose = Purpose.JOINT if activation.frames is None else Purpose.POSE
        one, setup = self._connected(identity)
        if setup.purpose is not purpose:
            wanted = purpose.name.capitalize()
            raise NotAllowed(rf"EGMSetupUC has not set this EGM identity up with \{wanted}")
        if one.state == RUNNING:
            raise NotAllowed("the sensor guides the robot; EGMStop ends that")
        one.activation = activation

    def guide(self, identity: int, terms: GuidanceTerms) -> None:
        """Let the sensor guide the robot."""
        one, _ = self._connected(identity)
        if one.activation is None:
            raise NotAllowed("EGMRunJoint or EGMRunPose: EGMActJoint or EGMActPose comes first")
        if self._under_way is not None:
            raise NotAllowed("a sensor guides the robot already; EGMStop ends that")
        if self.unit.seat is not None:
            raise NotAllowed("robots that move together cannot be guided by a sensor")
        if len(terms.chosen) != len(one.activation.bands):
            raise NotAllowed("EGMRunJoint follows EGMActJoint, and EGMRunPose EGMActPose")
        self.clock.note_line()
        self.clock.come_to_rest()
        self.clock.await_restart()
        self._begin(one, terms)
        if terms.waits:
            self._await(one)

    def await_condition(self, identity: int) -> None:
        """Wait until the robot that is guided is there."""
        one, _ = self._connected(identity)
        self.clock.note_line()
        self.clock.come_up()
        if self._under_way is not None and self._under_way.identity is one:
            self._under_way.waits = True
        self._await(one)

    def end_guidance(self, identity: int, *, goes_back: bool, ramp_out_s: float) -> None:
        """End the guidance."""
        one, _ = self._connected(identity)
        self.clock.note_line()
        self.clock.come_up()
        under_way = self._under_way
        if under_way is None or under_way.identity is not one:
            return
        under_way.run.stop(goes_back=goes_back, ramp_out_s=ramp_out_s)
        while self._under_way is under_way:
            self.clock.await_event(math.inf)

    def stream(self, identity: int, sample_s: float | None) -> None:
        """Tell the sensor where the robot is."""
        self._connected(identity)
        del sample_s

    def give_back(self, identity: int) -> None:
        """End all of it and give the identity back."""
        one = self._identities.get(identity)
        if one is None:
            return
        self.clock.come_up()
        if self._under_way is not None and self._under_way.identity is one:
            self.unit.own.end_guidance()
            self._settle()
            self.clock.come_to_rest()
        self._close(one)
        del self._identities[identity]

    def state(self, identity: int) -> float:
        """The state of an identity."""
        self.clock.come_up()
        self._settle()
        one = self._identities.get(identity)
        return DISCONNECTED if one is None else one.state

    def forget_all(self) -> None:
        """The program is taken off: no sensor is talked to any more."""
        self._settle()
        for one in self._identities.values():
            self._close(one)
        self._identities.clear()

    # Its cycles: implements `clock.Happening`.

    def next_s(self) -> float | None:
        """When the next cycle is [s]."""
        self._settle()
        return None if self._under_way is None else self._under_way.next_s

    def pass_next(self, passed_s: float, until_s: float) -> float:
        """Go on by a cycle."""
        del passed_s, until_s
        under_way = self._under_way
        assert under_way is not None
        now_s, answer = under_way.next_s, None
        identity, run = under_way.identity, under_way.run
        assert identity.sensor is not None
        if under_way.cycles % under_way.told.samples == 0:
            answer = identity.sensor.exchange(under_way.told.feedback(run, now_s))
        assert identity.activation is not None
        values = identity.activation.values
        if answer is not None and values is not None:
            values[: len(answer.values)] = answer.values[: len(values)]
        under_way.step(answer)
        if run.is_over:
            self.unit.own.end_guidance()
            self._settle()
            failed = run.ended in (Ended.SILENT, Ended.OUT_OF_REACH)
            if failed and not under_way.waits:
                error = self._failure(identity, run.ended)
                raise NotAllowed(str(error))
        return now_s

    def look_from(self, time_s: float) -> None:
        """Cycles keep their times."""

    # Within.

    def _begin(self, one: _Identity, terms: GuidanceTerms) -> None:
        activation, setup = one.activation, one.setup
        assert activation is not None
        assert setup is not None
        assert one.sensor is not None
        queue, robot = self.unit.own, self.resolver.robot
        stands, limits = queue.standing(), self.limits()
        count = len(robot.joints)
        axes = GuidedAxes(
            robot.lower,
            robot.upper,
            limits.max_speed[:count],
            limits.max_acceleration[:count],
        )
        frames = frames_of(self.resolver, self.state_of_motion, activation, stands)
        run = GuidedRun(
            JointMotion(axes, stands.joints.copy(), np.zeros(count)),
            self._aim(one, activation, terms, stands.joints),
            Tuning(one.data.gain * terms.gain, math.radians(activation.max_speed)),
            Terms(
                terms.condition_s,
                terms.ramp_in_s,
                setup.silence_s,
                terms.goes_back,
                terms.ramp_out_s,
            ),
        )
        first = math.ceil(self.clock.observe() / CYCLE_S - _ROUNDING)
        told = Teller(
            first * CYCLE_S,
            max(1, round(activation.sample_s / CYCLE_S)),
            GuidedFeedback(frames, _used(self.resolver.ext_joint(stands.external))),
        )
        stretch = GuidedStretch(
            told.first_s,
            CYCLE_S,
            robot.forward,
            frames.tcp_from_flange,
            stands.external,
            stands.joints,
        )
        self._under_way = _UnderWay(one, run, told, stretch, terms.waits)
        self._last = None
        queue.guide(self._under_way)
        one.state = RUNNING
        one.sensor.begin(run, told)
        self.clock.event(EventKind.GUIDANCE, f"guided by {setup.device}", device=setup.device)
        self.clock.tell()
        self.clock.grant()

    def _aim(
        self, one: _Identity, activation: Activation, terms: GuidanceTerms, start: Array
    ) -> Aim:
        filters = [activation.filter_hz]
        if one.data.filters:
            filters.append(one.data.bandwidth_hz)
        count = len(start) if activation.frames is None else 6
        chosen = np.array(terms.chosen[:count])
        bands = np.array([band or DEFAULT_BAND for band in activation.bands[:count]])
        if not chosen.any():
            chosen = np.ones(count, dtype=bool)
        if activation.frames is None:
            lowest, highest = np.radians(bands).T
            return JointAim(Band(chosen, lowest, highest), tuple(filters), start)
        return pose_aim(
            self.resolver,
            self.unit.own.standing(),
            self.state_of_motion,
            activation,
            terms.offset,
            bands,
            chosen,
            tuple(filters),
        )

    def _await(self, one: _Identity) -> None:
        """Wait until the guidance of an identity has ended."""
        with self.clock.waiting("the sensor that guides the robot") as wait:
            while self._guides(one):
                if not self.clock.await_event(math.inf):
                    raise WaitsForever("a sensor guides the robot, and nothing ends that")
            wait.ended_by = "the sensor that guides the robot"
        last, self._last = self._last, None
        if last is None or last[0] is not one or last[1] in (Ended.CONVERGED, Ended.STOPPED):
            return
        raise self._failure(one, last[1])

    def _guides(self, one: _Identity) -> bool:
        self._settle()
        return self._under_way is not None and self._under_way.identity is one

    def _settle(self) -> None:
        """Take note that the guidance has ended, here or because somebody has stopped the robot."""
        under_way = self._under_way
        if under_way is None or self.unit.own.guided is under_way:
            return
        identity, ended = under_way.identity, under_way.run.ended or Ended.STOPPED
        assert identity.sensor is not None
        identity.sensor.exchange(under_way.told.feedback(under_way.run, under_way.next_s))
        identity.sensor.end()
        if ended is Ended.SILENT and not under_way.run.has_heard:
            assert identity.setup is not None
            told = NobodyGuides(identity.setup.device)
            self.journal.finding(told, self.clock.place, once=told)
        self._under_way, self._last = None, (identity, ended)
        identity.state = CONNECTED
        self.cell.happenings += 1

    def _failure(self, one: _Identity, ended: Ended | None) -> RapidError | NotAllowed:
        assert one.setup is not None
        device = one.setup.device
        if ended is Ended.SILENT:
            return rapid_error(
                ERR_UDPUC_COMM,
                f"the sensor of `{device}` has said nothing for {one.setup.silence_s:g} s",
            )
        return NotAllowed(
            f"the sensor of `{device}` wants the robot where it cannot get: out of reach, or in "
            "another configuration"
        )

    def _of(self, identity: int) -> _Identity:
        one = self._identities.get(identity)
        if one is None:
            raise NotAllowed("the EGM identity is not there; EGMGetId makes it")
        return one

    def _connected(self, identity: int) -> tuple[_Identity, SensorSetup]:
        one = self._of(identity)
        if one.setup is None:
            raise NotAllowed("no sensor is connected with the EGM identity; EGMSetupUC comes first")
        return one, one.setup

    def _data(self, name: str) -> ExternalMotionData:
        """A configuration of External Motion Interface Data by name."""
        known = self.cell.parameters.instances("MOC", "EXT_MOTION_DATA") or ()
        for one in known:
            if one.get("name", "").lower() == name.lower():
                return ExternalMotionData(
                    one.get("ext_motion_level", "1") != "0",
                    _number(one.get("ext_motion_kp"), DEFAULT_DATA.gain),
                    _number(one.get("ext_motion_filter_bandwidth"), DEFAULT_DATA.bandwidth_hz),
                )
        if name.lower() == "default" or not known:
            return DEFAULT_DATA
        raise NotAllowed(f"EGMSetupUC: MOC.cfg has no External Motion Interface Data `{name}`")

    def _close(self, one: _Identity) -> None:
        if one.sensor is not None:
            one.sensor.close()
        one.sensor, one.state = None, DISCONNECTED


def _used(external: ExtJoint) -> tuple[float, ...]:
    """The external axes that are there [deg, mm]."""
    return tuple(value for value in external if value != UNUSED_AXIS)


def _number(text: str | None, otherwise: float) -> float:
    """A parameter of the configuration; what is no number that can be is as if it were missing."""
    try:
        value = float(text or "")
    except ValueError:
        return otherwise
    return value if 0.0 <= value < math.inf else otherwise
