"""Cache of results of earlier checks, by the fingerprint of all their inputs."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from rapidsim.diagnostics import Source
from rapidsim.files import DESCRIPTIONS
from rapidsim.jobs.cache.finding_records import NoRecordError, Record, StoredFindings, read_findings
from rapidsim.jobs.cache.fingerprints import NoFingerprintError, fingerprint, of_installation
from rapidsim.jobs.cache.result_store import ResultStore
from rapidsim.jobs.inputs.job import Job
from rapidsim.module_files import TaskFiles
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ResultCache:
    """Cache of results of jobs, and of the moves of tasks; always empty without a store."""

    store: ResultStore | None = None

    def of_job(self, job: Job) -> StoredFindings | None:
        """Return the cached result of a job; None if there is no such result."""
        record = self._record(self._key(job, None))
        return None if record is None else _read_stored(record, job)

    def keep_job(self, job: Job, record: Record) -> StoredFindings:
        """Store the record of a job, and return its content."""
        return self._keep(self._key(job, None), record, job)

    def of_task(self, job: Job, task: TaskFiles) -> Record | None:
        """Return the cached record of the moves of one task of a job; None if there is none yet."""
        record = self._record(self._key(job, task))
        return None if record is None or _read_stored(record, job) is None else record

    def keep_task(self, job: Job, task: TaskFiles, record: Record) -> None:
        """Store the record of the moves of one task."""
        self._keep(self._key(job, task), record, job)

    def tidy(self) -> None:
        """Remove the least recently used records, if the store is too large."""
        if self.store is not None:
            self.store.tidy()

    def _record(self, key: str | None) -> Record | None:
        record = None if self.store is None or key is None else self.store.value(key)
        return record if isinstance(record, list) else None

    def _keep(self, key: str | None, record: Record, job: Job) -> StoredFindings:
        found = read_findings(record, sources_of(job))
        if self.store is not None and key is not None and found.lasts:
            self.store.keep(key, record)
        return found

    def _key(self, job: Job, task: TaskFiles | None) -> str | None:
        """Return the fingerprint of all inputs of a result; None if the result must not be cached.

        Arms and shapes of links in the user's own files are not cached: they are read only during
        the check.
        """
        if self.store is None:
            return None
        robots = job.station.robots
        arms = (job.robot.name, *(robot.name or "" for robot in robots))
        if any(name.lower().endswith(DESCRIPTIONS) for name in arms):
            return None
        if any(robot.shapes is not None for robot in robots):
            return None
        names = [(file.name, os.path.realpath(file.name)) for file in job.files]
        cell = (job.request, job.station, job.cell, job.robot)
        of = job.tasks if task is None else task
        with suppress(NoFingerprintError, OSError):
            return fingerprint(of_installation(self.store), str(Path.cwd()), names, *cell, of)
        return None


def sources_of(job: Job) -> tuple[Source, ...]:
    """Return the texts of a job's files."""
    return tuple(Source(file.name, file.text) for file in job.files)


def _read_stored(record: Record, job: Job) -> StoredFindings | None:
    try:
        return read_findings(record, sources_of(job))
    except NoRecordError:
        return None
