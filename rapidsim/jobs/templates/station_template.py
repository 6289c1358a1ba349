"""Template of a station file from the known facts about the programs' cell: `rapidsim init`.

A backup contains most of it. In a folder of modules each `main` is a separate task; a module
without one belongs to the tasks that use its declarations. Configuration files (SYS.cfg, EIO.cfg,
MOC.cfg) in a folder that the user names count as on a controller.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from rapidsim.analysis.names.name_violations import AssumedData, UnknownRoutine, UnknownType
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.controller.cell.description import CellIo, SignalDeclaration, SignalKind
from rapidsim.diagnostics import Source
from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.checking.checked_program import load_task
from rapidsim.jobs.inputs.input_resolution import configured_station
from rapidsim.jobs.inputs.task_files import all_tasks
from rapidsim.jobs.templates.stimulus_suggestions import other_undriven, suggested_stimuli
from rapidsim.module_files import (
    Backup,
    TaskFiles,
    backup_among,
    configuration_below,
    loose_cell_among,
    packed_station,
    read_tasks,
)
from rapidsim.motion.robot.robot import load_robot
from rapidsim.reach.dataflow.written_moves import written_move_count
from rapidsim.station.backup.standalone_configuration import (
    StandaloneConfiguration,
    loose_configuration,
)
from rapidsim.station.cell_names import declared_names
from rapidsim.station.station import FILE_NAME, Station
from rapidsim.station.task_kind import TaskKind
from rapidsim.station.template import (
    NOT_NAMED,
    StationTemplate,
    Suggestions,
    TemplateRobot,
    TemplateTask,
)
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.values import value_class

_COMMENT = re.compile(r"!.*")
_NAME = re.compile(r"[A-Za-z]\w*")
_MAIN = "main"


@value_class(frozen=True, slots=True)
class StationTemplateFile:
    """Template of a station file with its path."""

    path: Path
    draft: StationTemplate
    lacks: tuple[str, ...] = ()
    """Notices about features of a backup that a run lacks, or that the template cannot supply."""


@value_class(frozen=True, slots=True)
class _Module:
    """A file of a folder, with the facts that determine its task."""

    source: SourceFile
    declares: frozenset[str]
    uses: frozenset[str]
    has_main: bool
    moves: bool

    @property
    def name(self) -> str:
        """Name of the file without suffix, folded."""
        return Path(self.source.name).stem.lower()


def station_template(paths: Sequence[str], robot: str | None) -> StationTemplateFile:
    """Return the possible content of a station file for programs, and its path.

    Args:
        paths: As for other commands; also folders of configuration files.
        robot: The requested arm; None if not specified.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID.
    """
    configured = [path for path in paths if _is_configuration_only(path)]
    programs = [path for path in paths if path not in configured]
    if not programs:
        raise InputError("no RAPID file was named", "give a module, a folder or a backup")
    cell = backup_among(programs) or loose_cell_among(programs)
    if cell is not None:
        # A packed station is unpacked to a temporary folder; its file is next to the archive.
        packed = next((one for path in programs if (one := packed_station(path))), None)
        folder = cell.root if packed is None else packed[0].parent
        is_backup = isinstance(cell, Backup)
        return _of_cell(programs, robot, folder / FILE_NAME, is_backup=is_backup)
    tasks = read_tasks(programs)
    configuration = loose_configuration(Path(configured[0])) if configured else None
    files = [file for task in tasks for file in task.files]
    folders = [os.path.realpath(Path(file.name).parent) for file in files]
    if len(programs) == 1 and Path(programs[0]).is_dir():
        # Where the same command finds it, though the modules may be in subfolders.
        folders = [os.path.realpath(programs[0])]
    folder = Path(os.path.commonpath(folders))
    return StationTemplateFile(folder / FILE_NAME, _of_modules(files, configuration, folder, robot))


def _is_configuration_only(path: str) -> bool:
    """Whether a path is a folder of configuration files without modules."""
    folder = Path(path)
    if path == "-" or not folder.is_dir() or configuration_below(folder) is None:
        return False
    return backup_among([path]) is None and loose_cell_among([path]) is None


def _of_cell(
    paths: Sequence[str], robot: str | None, file: Path, *, is_backup: bool
) -> StationTemplateFile:
    """Return the template for programs whose cell is described by their configuration files."""
    station = configured_station(paths)
    tasks = all_tasks(paths, station)
    arms = ", ".join(one.name or one.unknown or "" for one in station.robots)
    source = "the backup" if is_backup else "the configuration files"
    remarks = (
        f"Tasks, signals and wiring come from {source}: SYS.cfg and EIO.cfg.",
        *((f"So do the arms, from MOC.cfg: {arms}.",) if arms and robot is None else ()),
        "What is written here takes precedence.",
    )
    unknown = next((one.unknown for one in station.robots if one.unknown), None)
    robots = () if robot is None else (TemplateRobot(model=robot),)
    why = None
    if robot is None and (unknown is not None or not station.robots):
        why = f"the catalogue has no {unknown}" if unknown else "no arm is named"
        why = f"{why}: `rapidsim robots` lists those available"
    undeclared, missing, trees = _undeclared(tasks, station)
    suggestions = _suggested(tasks, trees, station.io)
    suggestions = replace(suggestions, arm=why, signals=undeclared, missing=missing)
    draft = StationTemplate(remarks, robots, suggestions=suggestions)
    lacks = station.remarks if robot else (*station.remarks, *_without_speeds(station))
    return StationTemplateFile(file, draft, lacks)


def _without_speeds(station: Station) -> Iterator[str]:
    """Yield notices about arms of the catalogue whose axis speeds are unknown."""
    for name in dict.fromkeys(one.name for one in station.robots if one.name):
        arm = load_robot(name)
        if all(joint.max_speed is not None for joint in arm.joints):
            yield from arm.notices
        else:
            yield (
                f"no source gives the axis speeds of {name}, which a run needs: "
                f"[motion] axis_speed = [...] in {arm.units('/s')}, one value per axis"
            )


def _of_modules(
    files: Sequence[SourceFile],
    configuration: StandaloneConfiguration | None,
    folder: Path,
    robot: str | None,
) -> StationTemplate:
    modules = [_module(file) for file in files]
    station = Station()
    robots: tuple[TemplateRobot, ...] = (
        (TemplateRobot(model=robot),) if robot else (TemplateRobot(),)
    )
    tasks: list[tuple[TemplateTask, list[_Module]]] = []
    if configuration is not None:
        station = replace(station, io=configuration.io, robots=configuration.robots)
        tasks = list(_configured(configuration, modules))
        robots = _robots_of(configuration, robot, sum(task.moves for task, _ in tasks))
        tasks = list(_with_robots(tasks, robots))
    elif sum(module.has_main for module in modules) > 1:
        tasks = list(_one_a_main(modules))
        movers = sum(task.moves for task, _ in tasks)
        if movers > 1:
            robots = tuple(TemplateRobot(f"robot{n}", robot) for n in range(1, movers + 1))
            tasks = list(_with_robots(tasks, robots))
    grouped = [TaskFiles(task.name, tuple(m.source for m in own)) for task, own in tasks]
    grouped = grouped or [TaskFiles(None, tuple(files))]
    named = tuple(
        replace(task, modules=tuple(_below(module, folder) for module in own))
        for task, own in tasks
    )
    undeclared, missing, trees = _undeclared(grouped, station)
    io = replace(station.io, signals=(*station.io.signals, *undeclared))
    return StationTemplate((), robots, named, io.signals, missing, _suggested(grouped, trees, io))


def _suggested(tasks: Sequence[TaskFiles], trees: Sequence[tree.File], io: CellIo) -> Suggestions:
    """Return suggested additions, as far as the programs imply them."""
    stimuli = suggested_stimuli(trees, io)
    texts = [file.text for task in tasks for file in task.files]
    return Suggestions(
        stimuli=stimuli,
        undriven=other_undriven(texts, io, stimuli),
        objects=bool(written_move_count(trees)),
    )


def _robots_of(
    configuration: StandaloneConfiguration, robot: str | None, movers: int
) -> tuple[TemplateRobot, ...]:
    """Return one robot per task that moves, but at least one."""
    known = configuration.robots
    found = []
    for number in range(max(movers, 1)):
        of = known[number] if number < len(known) else None
        label = of.label if of is not None and of.label else f"robot{number + 1}"
        model = robot or (of.name if of is not None else None)
        why = f"the catalogue has no {of.unknown}" if of is not None and of.unknown else NOT_NAMED
        found.append(TemplateRobot(label, model, why))
    return tuple(found)


def _with_robots(
    tasks: Iterable[tuple[TemplateTask, list[_Module]]], robots: Sequence[TemplateRobot]
) -> Iterator[tuple[TemplateTask, list[_Module]]]:
    """Yield the tasks; if there are several robots, each task that moves gets the next one."""
    labels = iter([robot.label for robot in robots])
    for task, own in tasks:
        named = replace(task, robot=next(labels)) if task.moves and len(robots) > 1 else task
        yield named, own


def _configured(
    configuration: StandaloneConfiguration, modules: Sequence[_Module]
) -> Iterator[tuple[TemplateTask, list[_Module]]]:
    """Yield the tasks of a configuration with their modules.

    Modules that it does not load belong to the first task that moves, if that task uses them.
    """
    named = {name for task in configuration.tasks for name in task.modules}
    others = [module for module in modules if module.name not in named]
    taken = False
    for task in configuration.tasks:
        own = [module for module in modules if module.name in task.modules]
        if task.settings.moves and not taken:
            own, taken = [*own, *_needed(own, others)], True
        if not own:
            continue
        one = task.settings
        named_task = TemplateTask(
            one.name, (), one.kind, one.moves, entry=one.entry, refers_late=one.refers_late
        )
        yield named_task, own


def _one_a_main(modules: Sequence[_Module]) -> Iterator[tuple[TemplateTask, list[_Module]]]:
    """Yield a task for each main: T_ROB1, T_ROB2 ... if it moves, else named as its module."""
    mains = [module for module in modules if module.has_main]
    shared = [module for module in modules if not module.has_main]
    groups = [[main, *_needed([main], shared)] for main in mains]
    moving = [group for group in groups if any(module.moves for module in group)]
    left = _unused(shared, groups)
    for number, group in enumerate(moving or groups[:1], 1):
        yield TemplateTask(f"T_ROB{number}", ()), [*group, *(left if number == 1 else ())]
    others = [group for group in groups if group not in moving] if moving else groups[1:]
    kind = TaskKind.SEMISTATIC if moving else TaskKind.NORMAL
    for group in others:
        yield TemplateTask(Path(group[0].source.name).stem, (), kind, moves=False), group


def _unused(modules: Sequence[_Module], groups: Sequence[Sequence[_Module]]) -> list[_Module]:
    used = {module.name for group in groups for module in group}
    return [module for module in modules if module.name not in used]


def _needed(own: Sequence[_Module], other_modules: Sequence[_Module]) -> list[_Module]:
    """Return the modules among others that are used, directly or through other modules."""
    needed: list[_Module] = []
    while True:
        uses = frozenset().union(*(module.uses for module in (*own, *needed)))
        declares = frozenset().union(*(module.declares for module in (*own, *needed)))
        new = [
            one
            for one in other_modules
            if one not in needed
            and (uses - declares) & one.declares
            and not declares & one.declares
        ]
        if not new:
            return needed
        needed.append(new[0])


def _module(file: SourceFile) -> _Module:
    parsed = parse(Source(file.name, file.text)).file
    items = [item for module in parsed.modules for item in module.items]
    declares = frozenset(
        item.name.key
        for item in items
        if not isinstance(item, tree.InvalidStatement | tree.Placeholder)
        and getattr(item, "scope", None) != "LOCAL"
    )
    has_main = any(isinstance(item, tree.Proc) and item.name.key == _MAIN for item in items)
    uses = frozenset(name.lower() for name in _NAME.findall(_COMMENT.sub("", file.text)))
    return _Module(file, declares, uses, has_main, bool(written_move_count([parsed])))


def _undeclared(
    tasks: Sequence[TaskFiles], station: Station
) -> tuple[tuple[SignalDeclaration, ...], tuple[str, ...], tuple[tree.File, ...]]:
    """Return undeclared signals that programs use, other undeclared names, and the programs."""
    names = replace(declared_names(station), assumes=True)
    signals: dict[str, SignalDeclaration] = {}
    others: dict[str, str] = {}
    files: list[tree.File] = []
    for task in tasks:
        loaded = load_task(task, names)
        files += loaded.files
        for one in loaded.diagnostics:
            match one.violation:
                case UnknownSignal(signal=name, type=of):
                    kind = SignalKind(of.removeprefix("signal"))
                    signals.setdefault(name.lower(), SignalDeclaration(name, kind))
                case (
                    UnknownRoutine(unknown=name, nearest=nearest)
                    | UnknownType(unknown=name, nearest=nearest)
                ):
                    meant = f" (or {nearest}?)" if nearest else ""
                    others.setdefault(name.lower(), f"{name}{meant}")
                case AssumedData(missing=name, type=of):
                    others.setdefault(name.lower(), f"{name} ({of})")
                case _:
                    pass
    return tuple(signals.values()), tuple(others.values()), tuple(files)


def _below(module: _Module, folder: Path) -> str:
    return Path(os.path.realpath(module.source.name)).relative_to(folder).as_posix()
