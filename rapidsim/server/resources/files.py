"""Files of clients, by their addresses: `fileservice/$HOME/log.txt`."""

from __future__ import annotations

from rapidsim.language.controller import DISK_BYTES
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.disks import DISKS


def disks(context: RequestContext, request: Request) -> Answer:
    """The disks: RobotWare 7 has them as folders, RobotWare 6 with their space [bytes]."""
    if request.generation == 2:
        return Answer(
            resources=tuple(Item("fs-dir", one, href=f"fileservice/{one}") for one in DISKS)
        )
    space = {"fs-total-space": str(DISK_BYTES), "fs-free-space": str(context.files.limit.free)}
    state = {"fs-enabled": "TRUE", "fs-readonly": "FALSE"}
    fixed, volatile = ({"fs-device-type": one, **space, **state} for one in ("fixed", "ramdisk"))
    items = (
        Item(
            "fs-device",
            f"${one}",
            volatile if one == "RAMDISK" else fixed,
            href=f"fileservice/${one}",
        )
        for one in DISKS
    )
    return Answer(resources=tuple(items))


def read(context: RequestContext, request: Request, address: str) -> Answer:
    """A file, or the entries of a folder."""
    del request
    found = context.files.read(address)
    return Answer(content=found) if isinstance(found, bytes) else found


def write(context: RequestContext, request: Request, address: str) -> Answer:
    """Write a file completely or not at all."""
    is_new = context.files.write(address, request.content)
    return Answer(status=201 if is_new else 200)


def remove(context: RequestContext, request: Request, address: str) -> Answer:
    """Remove a file, or a folder with all its contents."""
    del request
    context.files.remove(address)
    return DONE


def change(context: RequestContext, request: Request, address: str) -> Answer:
    """Create a folder in a folder, or rename or copy a file or a folder."""
    form = request.form
    action = form.get("fs-action", "")
    is_folder = context.files.change(address, action, form.get("fs-newname", ""))
    if action == "create":
        return Answer(status=201)
    return Answer() if is_folder and action == "rename" else DONE
