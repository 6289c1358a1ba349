"""Panels of the operator page beside the state: arm, data and routines, rules, backup.

Like the state they are reads without effect, and take no virtual time.
"""

from __future__ import annotations

import io
import zipfile
from itertools import islice
from typing import Final

from rapidsim.analysis.program import Storage
from rapidsim.diagnostics import all_rules
from rapidsim.language.data import UNUSED_AXIS
from rapidsim.report.html.arm_shapes import arm_data
from rapidsim.report.pages.rules import markdown
from rapidsim.server.messages import Answer, Fields
from rapidsim.server.resources.backups import backup_files
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, required_value
from rapidsim.server.resources.jogging import jogged_task
from rapidsim.simulation.live import symbols
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.position import position_snapshot
from rapidsim.simulation.live.states import RequestRefused
from rapidsim.simulation.live.symbols import TaskDatum

_MOST_DATA: Final = 500
"""Number of data of a module that are shown."""
_MOST_TEXT: Final = 2000
"""Length of a value that is shown."""
_MOST_BYTES: Final = 64 * 2**20
"""Size of the files of HOME in a download."""
_EARLIEST: Final = (1980, 1, 1, 0, 0, 0)
"""Date of each file of a backup, the first that its format has: equal backups are equal files."""


def arm_panel(context: RequestContext, query: Fields) -> dict[str, object]:
    """Return links and bodies of the arm of a mechanical unit, with the tool of its task.

    `arm` is None for an arm that the page cannot draw.
    """
    task = jogged_task(context, query)
    return {"arm": arm_data(task.unit.member.robot)}


def joints_panel(context: RequestContext, query: Fields) -> dict[str, object]:
    """Return the joints [deg, mm] of a mechanical unit now: all that its picture needs."""
    now = position_snapshot(jogged_task(context, query)).joints.robax
    return {"joints": [round(one, 3) + 0.0 for one in now if one != UNUSED_AXIS]}


def task_panel(context: RequestContext, query: Fields) -> dict[str, object]:
    """Return the procedures that a task may begin with, and the data of one of its modules.

    Raises:
        RefusedRequest: If there is no such task.
    """
    task = context.live.task(required_value(query, "task"))
    module = query.get("module", "").lower()
    found = (one for one in symbols.all_data(task) if (one.module or "").lower() == module)
    return {
        "routines": list(task.procedures()),
        "data": [_datum(task, one) for one in islice(found, _MOST_DATA)],
    }


def _datum(task: LiveTask, datum: TaskDatum) -> dict[str, object]:
    try:
        value: str | None = symbols.read(task, datum)[:_MOST_TEXT]
    except RequestRefused:
        value = None
    is_written = value is not None and datum.storage is not Storage.CONST
    return {
        "name": datum.name,
        "type": datum.type_name,
        "storage": datum.storage.value,
        "value": value,
        "settable": is_written,
    }


def rule_panel(context: RequestContext, query: Fields) -> dict[str, object]:
    """Return the text of `rapidsim explain` for the code of a rule.

    Raises:
        RefusedRequest: If there is no such rule.
    """
    del context
    code = required_value(query, "code").upper()
    for rule in all_rules():
        if rule.code == code:
            return {"code": rule.code, "name": rule.name, "text": markdown(rule)}
    raise refused(NOT_FOUND, f"there is no rule {code}")


def backup_panel(context: RequestContext, query: Fields) -> Answer:
    """Return a backup as a ZIP file, which `rapidsim check` reads once it is unpacked.

    Raises:
        RefusedRequest: If the files of HOME are too large for one answer.
    """
    generation = 2 if query.get("generation") == "2" else 1
    files = dict(context.files.home_files())
    if sum(one.stat().st_size for one in files.values()) > _MOST_BYTES:
        raise refused(BAD_PARAMETER, "HOME is too large for a download: `/ctrl/backup` makes one")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in backup_files(context, generation):
            entry = zipfile.ZipInfo(path, _EARLIEST)
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
        for name, file in files.items():
            archive.writestr(zipfile.ZipInfo(f"HOME/{name}", _EARLIEST), file.read_bytes())
    return Answer(content=packed.getvalue())
