"""Parser of `BACKINFO/backinfo.txt` in a controller backup: products, tasks and their modules.

>>PRODUCTS_ID:
RobotWare Version: 6.08.01.00
  616-1 PC Interface
>>TASK1: (T_ROB1,Program,)
SYSMOD/user.sys @
PROGMOD/MainModule.mod @
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rapidsim.values import value_class

_TASK = re.compile(r">>(TASK\d+):\s*\(\s*([^,)\s]+)", re.IGNORECASE)
_MODULE = re.compile(r"([^@]+?)\s*@.*")


@value_class(frozen=True, slots=True)
class ListedTask:
    """A task of a backup."""

    name: str
    modules: tuple[str, ...]
    """Folded paths below the folder of the task, with `/`; empty if the file lists none."""


def listed_products(text: str) -> tuple[str, ...]:
    """Return RobotWare, options and drives of a controller, each as written."""
    products: list[str] = []
    inside = False
    for line in text.replace("\r", "\n").splitlines():
        if line.startswith(">>"):
            inside = line.upper().startswith(">>PRODUCTS_ID")
        elif inside and line.strip():
            products.append(line.strip())
    return tuple(products)


def listed_tasks(text: str) -> Mapping[str, ListedTask]:
    """Return the tasks by folded name of their folder."""
    tasks: dict[str, ListedTask] = {}
    folder = ""
    for line in text.replace("\r", "\n").splitlines():
        line = line.strip()
        if line.startswith(">>"):
            task = _TASK.match(line)
            folder = task[1].lower() if task else ""
            if task:
                tasks[folder] = ListedTask(task[2], ())
        elif folder and (module := _MODULE.fullmatch(line)):
            known = tasks[folder]
            path = module[1].replace("\\", "/").lower()
            tasks[folder] = ListedTask(known.name, (*known.modules, path))
    return tasks
