"""Inputs and limits of a job's run, except those of individual tasks."""

from __future__ import annotations

from rapidsim.controller.cell.inputs import START_OF_TIME
from rapidsim.jobs.inputs.job import Job
from rapidsim.simulation.options import RunOptions


def run_options(job: Job) -> RunOptions:
    """Return the options of the request, else those of the station, without options on files."""
    asked, station = job.request, job.station
    return RunOptions(
        program_files=tuple(file.name for file in job.files),
        model=station.model,
        nearest_configuration=station.nearest_configuration or not job.is_arm_named,
        exact_configuration=station.exact_configuration,
        io=station.io,
        answers=asked.answers,
        answers_are_typed=asked.answers_are_typed,
        network=asked.network,
        cell_tasks=tuple(task.name for task in station.tasks),
        configured=station.configured,
        starts_at=asked.starts_at or station.starts_at or START_OF_TIME,
        max_time_s=asked.max_time_s,
        max_wall_s=asked.max_wall_s,
        geometry=station.geometry,
        hulls=asked.hulls if asked.cell is None else asked.cell.hulls,
        max_cycles=asked.max_cycles,
        entry=asked.entry,
    )
