"""A run as one JSON object: plain Python numbers, all finite, keys in a fixed order."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.json_records.encoding import json_of as record_json
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.dynamics import PRIOR_FACTOR
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import model_of, torques_of
from rapidsim.report.findings.diagnostic_records import diagnostic_record
from rapidsim.report.findings.merging import merged
from rapidsim.report.run.collision_records import clearance_records, contact_records
from rapidsim.report.run.error_records import error_records
from rapidsim.report.run.figures import Figures, JointMargin, OffPath, SingularityMargin
from rapidsim.report.run.long_programs import regions_json, slow_sections_json
from rapidsim.report.run.records import json_of, move_records, number, wait_records
from rapidsim.report.run.verdicts import NOTHING_ASKED, Verdicts
from rapidsim.simulation.results.event_values import event_record
from rapidsim.simulation.results.regions import by_comment
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.results.slow_sections import slow_sections
from rapidsim.simulation.results.time_shares import Share

SCHEMA = 3
_LIGHT_LOAD = 0.01
"""Share of the rated payload that is not worth a word."""
PROGRAM_POINTER = (
    "runs ahead of the robot: it continues after a fly-by move when the robot starts that move"
)


def run_json(
    simulation: Simulation,
    figures: Figures,
    findings: Sequence[Diagnostic],
    files: Mapping[str, object],
    judgement: Verdicts = NOTHING_ASKED,
) -> dict[str, object]:
    """The object that `rapidsim run --format json` prints.

    Args:
        simulation: The run.
        figures: Its figures.
        findings: What checking and running found.
        files: Paths of the files written, by kind; `program` lists the program's own.
        judgement: What became of assertions and the cycle budget.
    """
    report = course_json(simulation, findings)
    verdict = judgement.verdict_of(simulation)
    ran = {
        "ok": verdict.ok,
        "qualifications": list(verdict.qualifications),
        "slowest": [_share(share, "to") for share in figures.slowest],
        "min_joint_margin": _margin(figures.joint_margin),
        "min_singularity": _singularity(figures.singularity),
        "max_off_path": _off_path(figures.off_path),
        "slowest_waits": [_share(share, "for") for share in figures.slowest_waits],
        "stretches": slow_sections_json(slow_sections(simulation)),
        "regions": regions_json(by_comment((*simulation.moves, *simulation.waits))),
        "unsimulated": [
            {"name": one.name, "count": one.count, "treated_as": one.treated_as}
            for one in simulation.unsimulated
        ],
        "skipped": [{"name": one.name, "count": one.count} for one in simulation.skipped],
        "persistents": [
            {"name": one.name, "module": one.module, "old": one.old, "new": one.new}
            for one in simulation.persistents
        ],
        **judgement.as_json(),
        "models": {
            **models(simulation),
            "time_s_with_acceleration_times": {
                f"{other.factor:g}": number(other.time_s) for other in figures.sensitivity
            },
        },
        "files": {
            **files,
            "home": [{"path": file.path, "size": file.size} for file in simulation.home_files],
        },
    }
    assert report.keys() >= ran.keys()
    return report | ran | _collisions(simulation)


def course_json(simulation: Simulation, findings: Sequence[Diagnostic]) -> dict[str, object]:
    """The events and moves of the object, without the figures, which take long.

    It is what two runs are compared by.
    """
    first = simulation.robots[0].robot.name
    return rejected_json(simulation.program, first, findings, _robots(simulation)) | {
        "end": simulation.end.value,
        "time_s": number(simulation.time_s),
        "motion_s": number(simulation.motion_s),
        "wait_s": number(simulation.wait_s),
        "path_mm": number(simulation.path_m * 1000.0),
        "moves": [json_of(move) for move in move_records(simulation)],
        "waits": [json_of(wait) for wait in wait_records(simulation)],
        "events": [event_record(event) for event in simulation.events],
        "errors": [json_of(error) for error in error_records(simulation)],
        "models": models(simulation),
    }


def rejected_json(
    program: Sequence[str],
    robot: str,
    findings: Sequence[Diagnostic],
    robots: Sequence[object] = (),
) -> dict[str, object]:
    """The object for a program that cannot run because of its errors.

    It has all keys in order; a run replaces their values.
    """
    return {
        "schema": SCHEMA,
        "program": list(program),
        "robot": robot,
        **({"robots": robots} if robots else {}),
        "ok": False,
        "qualifications": [],
        "end": End.ERROR.value,
        "time_s": 0.0,
        "motion_s": 0.0,
        "wait_s": 0.0,
        "path_mm": 0.0,
        "moves": [],
        "slowest": [],
        "min_joint_margin": None,
        "min_singularity": None,
        "max_off_path": None,
        "diagnostics": [record_json(diagnostic_record(finding)) for finding in merged(findings)],
        "waits": [],
        "slowest_waits": [],
        "stretches": [],
        "regions": [],
        "events": [],
        "errors": [],
        "unsimulated": [],
        "skipped": [],
        "persistents": [],
        **NOTHING_ASKED.as_json(),
        "models": {},
        "files": {},
    }


def models(simulation: Simulation) -> dict[str, object]:
    """The models behind the numbers and their parameters, and what they leave out of the arm."""
    model = simulation.model
    resolved = [model_of(one.robot, model) for one in simulation.robots]
    return {
        "motion": model.version,
        "controller": model.controller,
        "acceleration": "; ".join(
            of_robots(simulation, lambda robot: [_acceleration(model, robot)])
        ),
        **_load(simulation),
        **_axis_speeds(simulation),
        "corner": model.corner,
        "program_pointer": PROGRAM_POINTER,
        "filter_time_s": max(one.window for one in resolved),
        "smoothing": model.smoothing,
        "fine_dwell_s": max(one.dwell for one in resolved),
        **_ramps(simulation),
        "robot_not_modelled": of_robots(simulation, lambda robot: robot.not_modelled),
    }


def of_robots(simulation: Simulation, texts: Callable[[Robot], Sequence[str]]) -> list[str]:
    """Notes on the robots of a run, deduplicated; with names unless all share the note."""
    robots = {one.robot.name: one.robot for one in simulation.robots}
    said: dict[str, list[str]] = {}
    for name, robot in robots.items():
        for text in texts(robot):
            said.setdefault(text, []).append(name)
    return [
        text if len(names) == len(robots) else f"{', '.join(names)}: {text}"
        for text, names in said.items()
    ]


def _axis_speeds(simulation: Simulation) -> dict[str, str]:
    """The source of axis speeds other than the arm's own."""
    given = simulation.model.max_speed
    if given is not None:
        units = simulation.robots[0].robot.units("/s")
        return {"axis_speed": f"axis speeds {_degrees(given)} {units}, as the station file says"}
    lent = "; ".join(of_robots(simulation, _speed_lender))
    return {"axis_speed": lent} if lent else {}


def _speed_lender(robot: Robot) -> list[str]:
    """The arm whose axis speeds a robot uses; empty if they are its own."""
    if robot.axis_speeds_from is None:
        return []
    return [f"axis speeds of {robot.axis_speeds_from}, no source gives those of {robot.name}"]


def _acceleration(model: MotionModel, robot: Robot) -> str:
    """Note on the assumed accelerations of an arm."""
    if torques_of(robot, model):
        assert robot.dynamics is not None
        known = (
            "as measured on this arm"
            if robot.dynamics.torques.measured
            else f"scaled from measured arms, accurate within a factor of {PRIOR_FACTOR:g}"
        )
        factors = (*model.torque, model.wrist)
        fitted = ""
        if factors != (1.0,) * len(factors):
            numbers = ", ".join(f"{factor:g}" for factor in factors)
            fitted = f", times {numbers} as the station file says"
        return f"torques of axes 1 to 3 and accelerations of the wrist {known}{fitted}"
    measured = [a for joint in robot.joints if (a := joint.max_acceleration) is not None]
    if model.acceleration is not None:
        return f"axis accelerations {_degrees(model.acceleration)} {robot.units('/s2')}"
    if model.version == "1" and model.own_accelerations and any(measured):
        return f"axis accelerations {_degrees(measured)} {robot.units('/s2')}, measured on this arm"
    return f"axis acceleration = axis speed / {model.acceleration_time:g} s"


def _load(simulation: Simulation) -> dict[str, object]:
    """Note on the modelled effect of loads; empty if none adds to the inertia of an arm."""
    for one in simulation.robots:
        if torques_of(one.robot, simulation.model) and any(
            segment.load > _LIGHT_LOAD
            for piece in one.trajectory.pieces
            for segment in piece.path.segments
        ):
            return {"payload": "the load is assumed to be a point mass at the wrist"}
    return {}


def _ramps(simulation: Simulation) -> dict[str, object]:
    """Note on the modelled effect of AccSet ramps; empty if no move has one."""
    if not any(robot.trajectory.has_ramps for robot in simulation.robots):
        return {}
    return {
        "ramp": "AccSet's ramp of p % smooths over 100 / p of that time (assumed, not measured)"
    }


def _degrees(values: Sequence[float]) -> str:
    return ", ".join(f"{math.degrees(value):g}" for value in values)


def _robots(simulation: Simulation) -> list[object]:
    """Robots with their tasks and base frames; empty if there is only one robot."""
    if len(simulation.robots) == 1:
        return []
    return [
        {
            "task": one.task,
            "robot": one.robot.name,
            "position_mm": [number(x * 1000.0) for x in one.world_from_base.translation],
            "quaternion": [number(q) for q in one.world_from_base.quaternion],
        }
        for one in simulation.robots
    ]


def _collisions(simulation: Simulation) -> dict[str, object]:
    """Contacts and least clearances; empty if the station has no bodies."""
    collisions = simulation.collisions
    if collisions is None:
        return {}
    nearest = collisions.nearest
    return {
        "collisions": [json_of(one) for one in contact_records(simulation)],
        "clearance_mm": None if nearest is None else number(nearest.distance_m * 1000.0),
        "clearances": [json_of(one) for one in clearance_records(simulation)],
        "not_judged": list(collisions.remarks),
    }


def _share(share: Share, goal: str) -> dict[str, object]:
    return {
        "file": share.place.span.file,
        "line": share.place.span.line,
        "routine": share.place.routine,
        "instruction": share.instruction,
        goal: share.goal,
        "time_s": number(share.seconds),
        "times": share.times,
    }


def _margin(margin: JointMargin | None) -> dict[str, object] | None:
    if margin is None:
        return None
    return {
        "margin_deg": number(margin.degrees),
        "joint": margin.joint,
        "time_s": number(margin.time_s),
        "move": margin.move.index,
        **_place(margin.move),
    }


def _singularity(singularity: SingularityMargin | None) -> dict[str, object] | None:
    if singularity is None:
        return None
    return {
        "smallest_singular_value": number(singularity.smallest_singular_value),
        "time_s": number(singularity.time_s),
        "move": singularity.move.index,
        **_place(singularity.move),
    }


def _off_path(off: OffPath | None) -> dict[str, object] | None:
    if off is None:
        return None
    return {
        "distance_mm": number(off.mm),
        "time_s": number(off.time_s),
        "move": off.move.index,
        **_place(off.move),
    }


def _place(move: ExecutedMove) -> dict[str, object]:
    return {"file": move.place.span.file, "line": move.place.span.line}
