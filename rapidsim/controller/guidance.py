"""Externally guided motion of one task: identities, and the robot guided by a sensor.

A guidance advances one cycle at a time, independent of the program, and uses the sensor's answers
at instants of virtual time. `cell.sensors` provides the sensors.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field, replace
from typing import ClassVar, Final

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.sensors import GuidanceSensor
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import MoveImpossible, WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import told_frames
from rapidsim.controller.moves.guidance_start import (
    GuidanceRequest,
    external_motion_data,
    started,
)
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.path_correction import ActivePathCorrection
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.sensor_exchange import data_for_sensor, take_answer
from rapidsim.controller.sensor_identities import ActiveGuidance, SensorIdentity
from rapidsim.controller.sensor_streams import SensorStream
from rapidsim.controller.signal_sensor import SignalSensor
from rapidsim.findings.runs import NobodyGuides
from rapidsim.language.error_numbers import ERR_UDPUC_COMM, rapid_error
from rapidsim.language.errors import NotAllowed, RapidError
from rapidsim.language.guidance import (
    CONNECTED,
    DISCONNECTED,
    NO_EXCHANGE,
    RUNNING,
    Activation,
    GuidanceTerms,
    Purpose,
    SensorSetup,
)
from rapidsim.language.moves import Move
from rapidsim.motion.guidance.feedback import Guided
from rapidsim.motion.guidance.guided_execution import EndReason
from rapidsim.motion.guidance.path_correction import PathCorrection
from rapidsim.motion.trajectory.corrected_section import CorrectedSection
from rapidsim.values import value_class

MOST_IDENTITIES: Final = 4
"""Maximum number of identities of a task at one time; from memory of ABB's documents."""
_OTHER_MODE: Final = "ABB 41826"


@value_class(slots=True, eq=False)
class TaskGuidance:
    """Implements `language.guidance.Guidance`; its cycles are a `event_source.EventSource`."""

    on_path: ClassVar = False
    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    state_of_motion: MotionState
    journal: Journal
    _identities: dict[int, SensorIdentity] = field(default_factory=dict)
    _active: ActiveGuidance | None = None
    _correcting: ActivePathCorrection | None = None
    """The correction of the path by a sensor; None once the robot has left the path."""
    _puts: bool = False
    """Whether a move is being appended to a corrected path."""
    _last: tuple[SensorIdentity, EndReason] | None = None
    """Identity and end of the last guidance, until the program has read it; else None."""

    # Requests of the program.

    def connect(self) -> int:
        """Create an identity."""
        number = next(n for n in range(1, MOST_IDENTITIES + 2) if n not in self._identities)
        if number > MOST_IDENTITIES:
            raise NotAllowed(
                f"EGMGetId: all {MOST_IDENTITIES} identities of the task are used; EGMReset first"
            )
        self._identities[number] = SensorIdentity()
        return number

    def set_up(self, identity: int, setup: SensorSetup) -> None:
        """Connect an identity with a sensor."""
        one = self._of(identity)
        if one.state == RUNNING:
            raise NotAllowed("EGMSetupUC: the sensor guides the robot; EGMStop ends that")
        self.clock.synchronise()
        data = external_motion_data(self.cell.parameters, setup.configuration)
        self._close(one)
        one.setup, one.data, one.activation, one.sample_s = setup, data, None, None
        one.exchange = NO_EXCHANGE
        one.sensor, one.state = self._sensor(setup), CONNECTED

    def activate(self, identity: int, activation: Activation) -> None:
        """Set the meaning of the sensor's goals."""
        purpose = Purpose.JOINT if activation.frames is None else Purpose.POSE
        one, setup = self._connected(identity)
        if setup.purpose is not purpose:
            wanted = purpose.name.capitalize()
            raise NotAllowed(
                rf"EGMSetupUC has not set this EGM identity up with \{wanted}", _OTHER_MODE
            )
        if one.state == RUNNING:
            raise NotAllowed("the sensor guides the robot; EGMStop ends that")
        one.activation, one.exchange = activation, activation.exchange
        if activation.streams:
            self._stream(one, activation.sample_s)
        elif one.stream is not None:
            self._stream(one, one.stream.sample_s)

    def guide(self, identity: int, terms: GuidanceTerms) -> None:
        """Let the sensor guide the robot."""
        one, _ = self._connected(identity)
        if one.activation is None:
            raise NotAllowed("EGMRunJoint or EGMRunPose: EGMActJoint or EGMActPose comes first")
        if self._active is not None:
            raise NotAllowed("a sensor guides the robot already; EGMStop ends that")
        if self.unit.team is not None:
            raise NotAllowed("robots that move together cannot be guided by a sensor")
        if self.unit.member.rides:
            raise NotAllowed("a robot that follows a conveyor cannot be guided by a sensor")
        self._end_correction()
        if len(terms.chosen) == len(one.activation.bands) and not any(terms.chosen):
            return
        if len(terms.chosen) != len(one.activation.bands):
            raise NotAllowed(
                "EGMRunJoint follows EGMActJoint, and EGMRunPose EGMActPose", _OTHER_MODE
            )
        self.clock.note_line()
        self.clock.bring_to_rest()
        self.clock.await_restart()
        self._begin(one, terms)
        if terms.waits:
            self._await(one)

    def activate_path(self, identity: int, sample_s: float) -> None:
        """Set the period [s] at which the sensor corrects a path."""
        one, setup = self._connected(identity)
        if setup.purpose is not Purpose.PATH_CORRECTION:
            raise NotAllowed(
                r"EGMSetupUC has not set this EGM identity up with \PathCorr", _OTHER_MODE
            )
        one.sample_s = sample_s

    def correct(self, identity: Callable[[], int], move: Move, put: Callable[[], None]) -> None:
        """Let the sensor correct the path of a move."""
        one, _ = self._connected(identity())
        if one.sample_s is None:
            raise NotAllowed(f"{move.instruction}: EGMActMove comes first")
        if self.unit.team is not None:
            raise NotAllowed("the path of robots that move together cannot be corrected")
        self.clock.note_line()
        if not self._corrects(one):
            self._end_correction()
            self.clock.bring_to_rest()
            self.clock.await_restart()
        correcting = self._correction_of(one, move)
        if not correcting.runs:
            correcting.begin(self.clock.resolve_time())
        one.state, self._puts = RUNNING, True
        self.clock.grant()
        try:
            put()
        except (RapidError, NotAllowed, MoveImpossible):
            if correcting.ended is not None:
                self._stop_on_path(correcting)
            raise
        finally:
            self._puts = False
        if not self.unit.queue.is_open:
            self._pause(correcting)

    def await_condition(self, identity: int) -> None:
        """Wait until the guided robot has reached its end condition."""
        one, _ = self._connected(identity)
        self.clock.note_line()
        self.clock.synchronise()
        if self._active is not None and self._active.identity is one:
            self._active.waits = True
        self._await(one)

    def end_guidance(self, identity: int, *, moves_back: bool, ramp_out_s: float | None) -> None:
        """End the guidance."""
        one, _ = self._connected(identity)
        self.clock.note_line()
        self.clock.synchronise()
        one.stream, under_way = None, self._active
        if self._corrects(one):
            self._end_correction()
        if under_way is None or under_way.identity is not one:
            return
        ramp_s = one.data.ramp_s if ramp_out_s is None else ramp_out_s
        under_way.run.stop(moves_back=moves_back, ramp_out_s=ramp_s)
        assert one.sensor is not None
        one.sensor.stop(moves_back=moves_back, ramp_out_s=ramp_s)
        while self._active is under_way:
            self.clock.await_event(math.inf)

    def stream(self, identity: int, sample_s: float | None) -> None:
        """Stream the robot's position to the sensor."""
        one, _ = self._connected(identity)
        self.clock.synchronise()
        self._stream(one, sample_s)

    def give_back(self, identity: int) -> None:
        """End guidance and streams, and release the identity."""
        one = self._identities.get(identity)
        if one is None:
            return
        self.clock.synchronise()
        if self._active is not None and self._active.identity is one:
            self.unit.end_guidance()
            self._settle()
            self.clock.bring_to_rest()
        if self._corrects(one):
            self._end_correction()
        self._close(one)
        del self._identities[identity]

    def state(self, identity: int) -> float:
        """The state of an identity."""
        self.clock.synchronise()
        self._settle()
        one = self._identities.get(identity)
        if one is None:
            return DISCONNECTED
        return one.state if one.stream is None else RUNNING

    def forget_all(self) -> None:
        """Close all connections to sensors, because the program is unloaded."""
        self._settle()
        self.unit.member.settle_correction()
        self._correcting = None
        for one in self._identities.values():
            self._close(one)
        self._identities.clear()

    # Its cycles: implements `event_source.EventSource`.

    def next_s(self) -> float | None:
        """Time [s] of the next cycle; None if there is none."""
        self._settle()
        streams = (stream.next_s for _, stream in self._streams())
        under_way_s = math.inf if self._active is None else self._active.next_s
        next_s = min(under_way_s, self._corrected_s(), min(streams, default=math.inf))
        return None if math.isinf(next_s) else next_s

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Carry out a cycle or a sample, or send the robot's position to a sensor."""
        del until_s
        under_way, corrected_s = self._active, self._corrected_s()
        due_s = min(corrected_s, math.inf if under_way is None else under_way.next_s)
        for one, stream in self._streams():
            if stream.next_s <= due_s:
                now_s, sent = stream.next_s, data_for_sensor(one.exchange, self.cell)
                answer = stream.send_due(
                    self.unit, self.resolver, self.state_of_motion, one.activation, sent
                )
                take_answer(one.exchange, answer, self.cell, self.clock.cause(), now_s)
                return now_s
        if corrected_s <= due_s:
            return self._sample(passed_s)
        assert under_way is not None
        return self._cycle(under_way)

    def advance_to(self, time_s: float) -> None:
        """Do nothing: cycles keep their times."""

    # Implementation.

    def _streams(self) -> list[tuple[SensorIdentity, SensorStream]]:
        """The streams in order of time, without that of the sensor that guides the robot."""
        guides = None if self._active is None else self._active.identity
        if self._correcting is not None and self._correcting.runs:
            guides = self._correcting.identity
        found = [
            (one, one.stream)
            for one in self._identities.values()
            if one.stream is not None and one is not guides
        ]
        return sorted(found, key=lambda item: item[1].next_s)

    def _stream(self, identity: SensorIdentity, sample_s: float | None) -> None:
        assert identity.sensor is not None
        identity.stream = None
        if sample_s is not None:
            now_s, awaits = self.clock.resolve_time(), identity.exchange.receives
            identity.stream = SensorStream(identity.sensor, sample_s, now_s, awaits)
            identity.stream.begin(now_s)
            self.clock.grant()

    def _cycle(self, active: ActiveGuidance) -> float:
        """Carry out a cycle; returns its time [s]."""
        now_s, answer = active.next_s, None
        identity, run = active.identity, active.run
        assert identity.sensor is not None
        if active.cycles % active.schedule.samples == 0:
            sent = data_for_sensor(identity.exchange, self.cell)
            told = replace(active.schedule.feedback(run, now_s), sent=sent)
            answer = identity.sensor.exchange(told)
            take_answer(identity.exchange, answer, self.cell, self.clock.cause(), now_s)
        active.step(answer)
        if run.is_over:
            self.unit.end_guidance()
            self._settle()
            failed = run.ended is not None and run.ended.is_failure
            if failed and not active.waits:
                error = self._failure(identity, run.ended)
                raise NotAllowed(str(error))
        return now_s

    def _begin(self, identity: SensorIdentity, terms: GuidanceTerms) -> None:
        assert identity.activation is not None
        assert identity.setup is not None
        assert identity.sensor is not None
        member = self.unit.member
        identity.exchange = terms.exchange.over(identity.activation.exchange)
        asked = GuidanceRequest(identity.setup, identity.data, identity.activation, terms)
        run, told, stretch = started(
            asked,
            self.resolver,
            self.state_of_motion,
            member.limits,
            member.standing(),
            self.clock.resolve_time(),
            data_for_sensor(identity.exchange, self.cell),
        )
        self._active = ActiveGuidance(identity, run, told, stretch, terms.waits, self._settle)
        self._last = None
        member.guide(self._active)
        identity.state = RUNNING
        identity.sensor.begin(run, told)
        device = identity.setup.device
        self.clock.event(EventKind.GUIDANCE, f"guided by {device}", device=device)
        self.clock.notify_tasks()
        self.clock.grant()

    def _corrects(self, identity: SensorIdentity) -> bool:
        return self._correcting is not None and self._correcting.identity is identity

    def _corrected_s(self) -> float:
        """Time [s] of the next sample of a correction; infinite without a correction."""
        if self._correcting is None or not self._correcting.runs:
            return math.inf
        return self._correcting.next_s

    def _correction_of(self, identity: SensorIdentity, move: Move) -> ActivePathCorrection:
        """The correction of the path to which a move is appended; a new one if it begins here."""
        member = self.unit.member
        external = member.end.external
        frames = told_frames(self.resolver, self.state_of_motion, move.tool, move.wobj, external)
        if self._correcting is not None and member.corrected is self._correcting:
            self._correcting.frames = frames
            return self._correcting
        assert identity.setup is not None
        assert identity.sensor is not None
        assert identity.sample_s is not None
        stretch = CorrectedSection(self.clock.resolve_time(), self.resolver.robot.kinematics)
        law = PathCorrection(
            identity.data.gain, (identity.data.bandwidth_hz,) if identity.data.filters else ()
        )
        correcting = ActivePathCorrection(
            identity,
            self.unit,
            self.resolver,
            identity.sensor,
            law,
            stretch,
            identity.sample_s,
            identity.setup.silence_s,
            self.clock.bring_to_rest,
            frames,
        )
        member.trajectory.correct(stretch)
        self._correcting = member.corrected = correcting
        device = identity.setup.device
        self.clock.event(EventKind.GUIDANCE, f"path corrected by {device}", device=device)
        return correcting

    def _sample(self, passed_s: float) -> float:
        """Correct the path up to the next sample; return the time [s] of this one."""
        correcting = self._correcting
        assert correcting is not None
        ended, now_s = correcting.sample(passed_s), max(passed_s, correcting.told_s)
        if ended is not None:
            correcting.ended, correcting.runs = ended, False
            if ended is EndReason.SILENT and not correcting.law.has_answer:
                self._discard_feedback(correcting.identity)
            failure = self._failure(correcting.identity, ended)
            raise failure if self._puts else NotAllowed(str(failure))
        return now_s

    def _stop_on_path(self, correcting: ActivePathCorrection) -> None:
        """Stop on a path whose correction has failed, and discard the rest of it."""
        rest_s = self.unit.halt(correcting.told_s)
        self.clock.go_to(max(self.unit.seen_s(rest_s), correcting.rest()))
        correcting.last_word(Guided.FAILED)
        self.unit.clear()
        self.unit.resume(self.clock.resolve_time())
        correcting.identity.state, self._correcting = CONNECTED, None

    def _pause(self, correcting: ActivePathCorrection) -> None:
        """Handle the stop of the robot at a stop point of its path."""
        if correcting.runs:
            self.clock.pass_time(max(self.clock.resolve_time(), correcting.rest()))
            correcting.last_word(Guided.STOPPED)
        correcting.identity.state = CONNECTED

    def _end_correction(self) -> None:
        """Let the robot finish a corrected path, and keep its offset."""
        correcting = self._correcting
        if correcting is None:
            return
        self.clock.bring_to_rest()
        self._pause(correcting)
        correcting.settle()
        self._correcting = None

    def _await(self, identity: SensorIdentity) -> None:
        """Wait until the guidance of an identity has ended."""
        with self.clock.waiting("the sensor that guides the robot") as wait:
            while self._guides(identity):
                if not self.clock.await_event(math.inf):
                    raise WaitsForever("a sensor guides the robot, and nothing ends that")
            wait.ended_by = "the sensor that guides the robot"
        last, self._last = self._last, None
        if last is not None and last[0] is identity and last[1].is_failure:
            raise self._failure(identity, last[1])

    def _guides(self, identity: SensorIdentity) -> bool:
        self._settle()
        return self._active is not None and self._active.identity is identity

    def _settle(self) -> None:
        """Record that the guidance has ended, by itself or because the robot was stopped."""
        under_way = self._active
        if under_way is None or self.unit.member.guided is under_way:
            return
        identity, ended = under_way.identity, under_way.run.ended or EndReason.STOPPED
        assert identity.sensor is not None
        identity.sensor.end(under_way.schedule.feedback(under_way.run, under_way.next_s))
        identity.stream = None
        if ended is EndReason.SILENT and not under_way.run.has_answer:
            self._discard_feedback(identity)
        self._active, self._last = None, (identity, ended)
        identity.state = CONNECTED
        self.cell.event_count += 1

    def _discard_feedback(self, identity: SensorIdentity) -> None:
        assert identity.setup is not None
        told = NobodyGuides(identity.setup.device)
        self.journal.finding(told, self.clock.place, once=told)

    def _failure(
        self, identity: SensorIdentity, ended: EndReason | None
    ) -> RapidError | NotAllowed:
        assert identity.setup is not None
        device = identity.setup.device
        if ended is EndReason.SILENT:
            return rapid_error(
                ERR_UDPUC_COMM,
                f"the sensor of `{device}` has sent nothing for {identity.setup.silence_s:g} s",
            )
        return NotAllowed(
            f"the sensor of `{device}` requests a place beyond the robot: out of reach, or in "
            "another configuration"
        )

    def _of(self, identity: int) -> SensorIdentity:
        one = self._identities.get(identity)
        if one is None:
            raise NotAllowed("the EGM identity is not there; EGMGetId makes it")
        return one

    def _connected(self, identity: int) -> tuple[SensorIdentity, SensorSetup]:
        one = self._of(identity)
        if one.setup is None:
            raise NotAllowed("no sensor is connected with the EGM identity; EGMSetupUC comes first")
        return one, one.setup

    def _sensor(self, setup: SensorSetup) -> GuidanceSensor:
        if not setup.signals:
            return self.cell.sensors.open(setup.device)
        return SignalSensor(self.cell, setup.signals, setup.purpose)

    def _close(self, identity: SensorIdentity) -> None:
        if identity.sensor is not None:
            identity.sensor.close()
        identity.sensor, identity.stream, identity.state = None, None, DISCONNECTED
