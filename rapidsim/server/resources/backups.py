"""Backups of the controller into its own files, and the progress of such operations.

A backup has programs with the current values of persistents, the configuration, and the files of
HOME, as `rapidsim check` and a controller read it. It is complete when the request is answered.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, required_value
from rapidsim.simulation.live import program_memory
from rapidsim.station.backup.cfg_file import configuration_text
from rapidsim.station.backup.robots import arm_type

_OPTIONS: Final = "PRESENT_OPTIONS"
"""Options are no part of SYS.cfg; `backinfo.txt` has them."""
_OPERATION: Final = "backup"


def create(context: RequestContext, request: Request) -> Answer:
    """Write a backup into a new folder, which must not be below HOME.

    Raises:
        RefusedRequest: If there is such a folder, it cannot be made, or the disk is full.
    """
    address = required_value(request.form, "backup").strip("/").removeprefix("fileservice/")
    if not context.files.is_below_a_disk(address):
        raise refused(BAD_PARAMETER, f"`{address}` cannot be the place of a backup")
    files: dict[str, bytes | Path] = dict(backup_files(context, request.generation))
    files |= {f"HOME/{name}": file for name, file in context.files.home_files()}
    context.files.write_folder(address, files)
    context.operations.append(_OPERATION)
    return Answer(status=202, location=f"/progress/{len(context.operations)}")


def state(context: RequestContext, request: Request) -> Answer:
    """Whether there has been a backup."""
    shown = "Backup Ready" if context.operations else "None"
    name = "backup state" if request.generation == 1 else "backup-state"
    return Answer((Item("ctrl-backup-state", "state", {name: shown}),))


def information(context: RequestContext, request: Request) -> Answer:
    """The progress of a backup: none ever takes time."""
    del context, request
    item = Item("ctrl-backup-info-li", "backup", {"progress-state": "idle"})
    return Answer((item,), links=("state",))


def operations(context: RequestContext, request: Request) -> Answer:
    """All operations that were answered with 202."""
    del request
    items = (
        Item("progress-li", title, href=f"/progress/{number}")
        for number, title in enumerate(context.operations, start=1)
    )
    return Answer(resources=tuple(items))


def operation(context: RequestContext, request: Request, number: str) -> Answer:
    """One operation.

    Raises:
        RefusedRequest: If there is none of this number.
    """
    del request
    for index, title in enumerate(context.operations, start=1):
        if number == str(index):
            return Answer((Item("progress", title, {"state": "ready", "code": "0"}),))
    raise refused(NOT_FOUND, f"there is no operation {number}")


def backup_files(context: RequestContext, generation: int) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of each file of a backup, but for those of HOME."""
    parameters, live = context.live.cell.parameters, context.live
    suffix = "" if generation == 1 else "x"
    version = context.versions[generation]
    options = parameters.instances("SYS", _OPTIONS) or ()
    lines = [">>PRODUCTS_ID:", f"RobotWare Version: {version.name}"]
    lines += [f"  {one.get('desc') or one.get('name', '')}" for one in options]
    for number, task in enumerate(live.tasks.values(), start=1):
        lines.append(f">>TASK{number}: ({task.name},Program,)")
        for module in program_memory.modules(task):
            is_system = program_memory.is_system_module(module)
            folder, end = ("SYSMOD", "sys") if is_system else ("PROGMOD", "mod")
            path = f"{folder}/{module.name.text}.{end}{suffix}"
            lines.append(f"{path} @")
            yield f"RAPID/TASK{number}/{path}", program_memory.file_of(task, module)
    yield "BACKINFO/backinfo.txt", program_memory.encoded("\n".join(lines) + "\n")
    for domain in parameters.domains:
        types = {
            of: [_with_arm_type(one) for one in parameters.instances(domain, of) or ()]
            for of in parameters.types(domain)
            if of != _OPTIONS
        }
        yield f"SYSPAR/{domain}.cfg", program_memory.encoded(configuration_text(domain, types))


def _with_arm_type(instance: Mapping[str, str]) -> Mapping[str, str]:
    """Return an instance with the type of its arm in place of a name in the catalogue."""
    arm = instance.get("use_robot_type")
    return instance if arm is None else {**instance, "use_robot_type": arm_type(arm)}
