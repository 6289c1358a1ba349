r"""Arc welding: lines and arcs at the speed of the weld, with the times of the seam.

ArcLStart moves to the seam at its own speed and waits while gas, ignition and heating take effect;
ArcL and ArcLEnd weld with `weld_speed` if the weld data define one, and ArcLEnd waits while filling
and cooling take effect. No arc is simulated: weaving, tracking and corrections do not move the
torch, which the run reports. Speeds of weld data are in mm/s.

ArcMoveExtJ moves external axes, synchronised with the robots that weld on them; its \ID and \Start
are those of programs in use.

Source: Application manual Arc and Arc Sensor, "ArcL", "ArcLStart", "ArcLEnd", "seamdata",
"welddata".
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Unpack

from rapidsim.language.annotations import Num, Pers, String, Switch, TriggData, Var
from rapidsim.language.arc_data import SeamData, TrackData, WeaveData, WeldData
from rapidsim.language.controller import Controller
from rapidsim.language.data import FINE, JointTarget, RobTarget, SpeedData, ToolData, ZoneData
from rapidsim.language.moves import Interpolation
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.motion import MoveOptions, build_move, move_external_axes, move_variants
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

INSTEAD = "a move with the speed of the weld and the times of the seam, without an arc"
_INSTEAD_OF_AXES = "a move of the external axes, without an arc"


class Phase(Enum):
    """The part of the seam that an instruction belongs to."""

    START = "Start"
    ON = ""
    END = "End"


class ArcOptions(MoveOptions, total=False):
    """Options of weld instructions in addition to those of other moves."""

    weave: WeaveData
    track: TrackData
    pre_process_tracking: Switch
    seam_name: String
    time: Num
    t1: Var[TriggData]
    t2: Var[TriggData]
    t3: Var[TriggData]
    t4: Var[TriggData]
    t5: Var[TriggData]
    t6: Var[TriggData]
    t7: Var[TriggData]


def _arc(phase: Phase) -> Callable[[str, Interpolation], Callable[..., None]]:
    def body_of(name: str, interpolation: Interpolation) -> Callable[..., None]:
        def body(
            controller: Controller,
            to_point: RobTarget,
            speed: SpeedData,
            seam: SeamData,
            weld: WeldData,
            zone: ZoneData,
            tool: Pers[ToolData],
            **options: Unpack[ArcOptions],
        ) -> None:
            controller.fidelity.not_simulated(name, INSTEAD)
            _report(controller, name, options)
            stands_s = _dwell_s(phase, seam)
            if phase is not Phase.START and weld.weld_speed > 0.0:
                speed = SpeedData(weld.weld_speed, *speed[1:])
            stops = phase is Phase.END or stands_s > 0.0
            to = FINE if stops else zone
            controller.motion.move(
                build_move(controller, name, interpolation, to_point, speed, to, tool, options)
            )
            if stands_s > 0.0:
                controller.clock.wait(stands_s, in_position=True)

        return body

    return body_of


def arc_move_ext_j(
    controller: Controller,
    to_joint_pos: JointTarget,
    speed: SpeedData,
    zone: ZoneData,
    *,
    start: Switch = False,
    **options: Unpack[MoveOptions],
) -> None:
    """Move the external axes only, with robots that weld."""
    controller.fidelity.not_simulated("ArcMoveExtJ", _INSTEAD_OF_AXES)
    move_external_axes(controller, "ArcMoveExtJ", to_joint_pos, speed, zone, options)


def _dwell_s(phase: Phase, seam: SeamData) -> float:
    """Time [s] that the torch waits at the end of a move."""
    if phase is Phase.START:
        return seam.preflow_time + seam.ign_move_delay + seam.heat_time
    if phase is Phase.END:
        return seam.cool_time + seam.fill_time + seam.bback_time + seam.postflow_time
    return 0.0


def _report(controller: Controller, name: str, options: ArcOptions) -> None:
    left_out = {
        r"\Weave": options.get("weave"),
        r"\Track": options.get("track"),
        r"\PreProcessTracking": options.get("pre_process_tracking"),
        r"\Time": options.get("time"),
        r"\T1": options.get("t1"),
    }
    note_ignored_options(controller.fidelity, name, left_out)


_ORDER = (
    r"ToPoint \ID Speed \V|\T Seam Weld \Weave Zone \Z \Inpos Tool \WObj \Corr \Track "
    r"\PreProcessTracking \SeamName \Time \T1 \T2 \T3 \T4 \T5 \T6 \T7 \TLoad"
)

ARC = table(
    *(
        row
        for phase in Phase
        for row in move_variants(
            f"Arc*{phase.value}",
            _arc(phase),
            _ORDER,
            ", welding",
            interpolations="LC",
            does=Trait.WAIT,
            treated_as=INSTEAD,
        )
    ),
    routine(
        "ArcMoveExtJ",
        arc_move_ext_j,
        r"ToJointPos \ID \UseEOffs Speed \T Zone \Inpos \Start",
        treated_as=_INSTEAD_OF_AXES,
    ),
)
