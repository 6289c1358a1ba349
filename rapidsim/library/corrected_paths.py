r"""Moves whose path a sensor corrects, as externally guided motion (EGM).

Source: Application manual Externally Guided Motion, "EGM Path Correction".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Final, Unpack

from rapidsim.language.annotations import Num, Pers, Var
from rapidsim.language.controller import Controller
from rapidsim.language.data import IDENTITY_POSE, Pose, RobTarget, SpeedData, ToolData, ZoneData
from rapidsim.language.moves import Interpolation, SensorInfluence
from rapidsim.library.guidance_arguments import (
    CorrectedOptions,
    EgmIdent,
    identity_number,
    sample_s,
)
from rapidsim.library.motion import build_move, move_variants
from rapidsim.library.table import routine

PATH_SAMPLE_MS: Final = 48.0
"""Default sample time [ms] of EGMActMove; from memory of ABB's documents."""
PATH_STEP_MS: Final = 24.0


def egm_act_move(
    controller: Controller,
    egmid: Var[EgmIdent],
    sensor_frame: Pose,
    *,
    sample_rate: Num | None = None,
) -> None:
    """Set the frame of a sensor that corrects paths, and its sample time."""
    if sensor_frame != IDENTITY_POSE:
        controller.fidelity.not_simulated(
            "EGMActMove SensorFrame", "the sensor is taken to measure in path coordinates"
        )
    controller.guidance.activate_path(
        identity_number(egmid, "EGMActMove"), sample_s(sample_rate, PATH_SAMPLE_MS, PATH_STEP_MS)
    )


def _corrected(name: str, interpolation: Interpolation) -> Callable[..., None]:
    """Build the function of a move whose path a sensor corrects."""

    def body(
        controller: Controller,
        egmid: Var[EgmIdent],
        to_point: RobTarget,
        speed: SpeedData,
        zone: ZoneData,
        tool: Pers[ToolData],
        **options: Unpack[CorrectedOptions],
    ) -> None:
        sensed = SensorInfluence.NOT_HERE if options.get("no_corr") else SensorInfluence.CORRECTED
        move = build_move(controller, name, interpolation, to_point, speed, zone, tool, options)
        move = replace(move, sensed=sensed)
        put = partial(controller.motion.move, move)
        controller.guidance.correct(lambda: identity_number(egmid, name), move, put)

    return body


CORRECTED_PATHS = (
    routine("EGMActMove", egm_act_move, r"EGMid SensorFrame \SampleRate"),
    *move_variants(
        "EGMMove*",
        _corrected,
        r"EGMid ToPoint Speed Zone Tool \WObj \TLoad \NoCorr",
        suffix=", on a path that a sensor corrects",
        interpolations="LC",
    ),
)
