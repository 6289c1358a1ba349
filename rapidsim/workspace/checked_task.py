"""One task of a workspace: its files, and the findings in them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.context import MOST_COMPARED, UnitResults
from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.passes.task_check import TaskCheck, deep_recursion
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Diagnostic
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused
from rapidsim.workspace.changes import Changed, TextChange, changed_text
from rapidsim.workspace.file_units import Edited, EditedData, EditedItems, EditedRoutine, FileUnits
from rapidsim.workspace.guesses import without_guesses
from rapidsim.workspace.placing import FilePlaces, addressed, renumbered
from rapidsim.workspace.task_rules import TaskRules
from rapidsim.workspace.total_order import in_total_order

_HEADERS = frozenset(
    {tree.Proc, tree.Func, tree.Trap, tree.ParameterDeclaration, tree.OptionalGroup}
)
"""Kinds of nodes that a routine keeps when its body changes."""


class CheckedTask:
    """The files of a task with their trees, symbols and findings.

    A change within the body of a routine has this routine parsed and checked again, and the rules
    asked again for it and for the task. Other, new or removed data and routines have in addition
    everything checked again that contains their names. Any other change has its file parsed and the
    task checked.
    """

    @gc_paused()
    def __init__(
        self,
        task: TaskFiles,
        rules: Sequence[Find],
        cell: CellNames,
        is_looked_for: Callable[[str], bool],
    ) -> None:
        """Read and check a task; see `Workspace` for the arguments."""
        self._task = task
        self._cell = replace(cell, unseen=task.unseen, refers_late=task.refers_late)
        self._rules = TaskRules(rules)
        self._is_looked_for = is_looked_for
        self._units = {file.name: FileUnits(file.name, file.text) for file in task.files}
        self._places = {path: FilePlaces(units.source) for path, units in self._units.items()}
        self._raw: dict[str, list[Diagnostic]] = {}
        self._findings: dict[str, tuple[Diagnostic, ...]] = {}
        self._check_all()
        self._collect()

    @property
    def task(self) -> TaskFiles:
        """The task with its present texts."""
        files = tuple(replace(file, text=self.text(file.name)) for file in self._task.files)
        return replace(self._task, files=files)

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of the files, in order."""
        return tuple(self._units)

    def text(self, path: str) -> str:
        """The present text of a file."""
        return self._units[path].source.written.text

    def file(self, path: str) -> tree.File:
        """The tree of a file."""
        return self._units[path].file

    @property
    def facts(self) -> Facts:
        """Symbols, types and scopes of the task."""
        return self._facts

    @gc_paused()
    def findings(self, path: str) -> tuple[Diagnostic, ...]:
        """Findings in a file."""
        if path not in self._findings:
            units = self._units[path]
            found = [*self._places[path].placed(self._raw[path]), *self._rules.in_file(units)]
            written = tree.File(units.source.written, (), units.suppressing)
            shown = without_suppressed(found, [written], is_looked_for=self._is_looked_for)
            self._findings[path] = in_total_order(shown)
        return self._findings[path]

    @gc_paused()
    def as_checked(self) -> tuple[tuple[tree.File, ...], tuple[Diagnostic, ...]]:
        """Return the trees and all findings, none suppressed, at their places in the trees.

        Findings have the order of a check: by place, those at one place by detector.
        """
        of_syntax = [
            renumbered(one)
            for units in self._units.values()
            for one in sorted(units.diagnostics, key=lambda one: one.order)
        ]
        found = [
            *self._check.diagnostics(),
            *self._rules.in_task(self._facts),
            *(
                addressed(one, units.source)
                for units in self._units.values()
                for one in self._rules.in_file(units)
            ),
        ]
        files = tuple(self._trees.values())
        found.sort(key=self._rules.rank)
        found = [*of_syntax, *without_guesses(found, of_syntax, files)]
        numbers = {path: number for number, path in enumerate(self._trees)}
        found.sort(key=lambda one: (numbers.get(one.order[0], -1), one.order[1]))
        return files, tuple(found)

    @gc_paused()
    def change(self, path: str, change: TextChange) -> Changed:
        """Change a text, and check what depends on it."""
        text = changed_text(self.text(path), [change])
        edited = self._units[path].edit(change)
        is_checked = (
            edited is not None
            and len(self._check.analysis.nearest) < MOST_COMPARED
            and self._recheck_edited(path, edited)
        )
        if not is_checked:
            return self.replace(path, text)
        return Changed(self._collect(path), is_local=True)

    @gc_paused()
    def replace(self, path: str, text: str) -> Changed:
        """Replace a text, and check the task."""
        self._units[path] = FileUnits(path, text)
        self._places[path] = FilePlaces(self._units[path].source)
        self._check_all()
        return Changed(self._collect(path))

    def _check_all(self) -> None:
        """Check all units."""
        self._trees = {path: units.file for path, units in self._units.items()}
        files = tuple(self._trees.values())
        self._check = TaskCheck(files, self._cell)
        self._facts = Facts(files, self._check.analysis)

    def _recheck_edited(self, path: str, edited: Edited) -> bool:
        """Check what depends on an edit; see `_recheck`."""
        match edited:
            case EditedRoutine():
                return self._recheck(path, edited)
            case EditedData():
                return self._recheck_data(path, edited)
            case EditedItems():
                return self._recheck_items(path, edited)

    def _recheck(self, path: str, edited: EditedRoutine) -> bool:
        """Check a routine with its new body.

        Returns:
            Whether its other results follow from the old ones; if not, the state is unusable.
        """
        check, analysis = self._check, self._check.analysis
        if not self._is_of_known_types(edited):
            return False
        routine, module = edited.routine, edited.module
        loads = bool(check.loading)
        self._forget(self._facts.part_of[routine])
        routine.take_body(edited.replacement)
        check.read_item(routine, module)
        if bool(check.loading) != loads:
            return False
        again = {routine: module}
        unread = "\n".join(check.unread.values())
        if unread != analysis.unread_text:
            analysis.unread_text = unread
            outside = (check.declarations, *check.values.values())
            if any(map(self._depends_on_unread, outside)):
                return False
            for other, unit in check.units.items():
                if other is not routine and self._depends_on_unread(unit):
                    part = self._facts.part_of[other]
                    self._forget(part)
                    again[other] = part.module
        return self._conclude(path, again)

    def _recheck_data(self, path: str, edited: EditedData) -> bool:
        """Check data with their new value, and everything that names them; see `_recheck`."""
        check, data = self._check, edited.data
        if not check.types.resolves(data.type.key, edited.module):
            # The value determines the shape of an undeclared type.
            return False
        check.forget_nodes(_nodes_of_value(data))
        data.take_value(edited.replacement)
        values = self._users_of({data: edited.module}, {data.name.key})
        names = {item.name.key for item in values}
        if self._determines_sizes(names):
            return False
        again: dict[tree.Routine, tree.Module] = {}
        for part in self._facts.parts:
            if part.routine is not None and not names.isdisjoint(part.names):
                self._forget(part)
                again[part.routine] = part.module
        self._check_values(values)
        return self._conclude(path, again, self._heads(set(values.values())))

    def _recheck_items(self, path: str, edited: EditedItems) -> bool:
        """Check other data and routines, and everything that names them; see `_recheck`."""
        check, module = self._check, edited.module
        if not all(self._is_plain(one, module) for one in (*edited.removed, *edited.added)):
            return False
        loads = bool(check.loading)
        names = check.change_items(module, edited.removed, edited.added)
        if names is None or not all(map(str.isascii, names)):
            return False
        if bool(check.loading) != loads or self._depends_on_unread(check.declarations):
            return False
        names |= check.forget_nearest(names)
        data = {item: module for item in edited.added if isinstance(item, tree.Data)}
        data |= {
            item: home
            for home in check.modules
            for item in home.items
            if isinstance(item, tree.Data) and self._depends_on_unread(check.values[item])
        }
        values = self._users_of(data, names)
        names |= {item.name.key for item in values}
        if self._determines_sizes(names):
            return False
        again: dict[tree.Routine, tree.Module] = {}
        for part in self._facts.routine_parts:
            routine = part.routine
            if routine in check.units and (
                not names.isdisjoint(part.words) or self._depends_on_unread(check.units[routine])
            ):
                self._forget(part)
                again[routine] = part.module
        new = {item: module for item in edited.added if isinstance(item, tree.Routine)}
        self._trees[path] = self._units[path].file
        self._facts = self._facts.with_items(tuple(self._trees.values()))
        self._check_values(values)
        return self._conclude(path, {**again, **new}, self._heads({module, *values.values()}))

    def _determines_sizes(self, names: set[str]) -> bool:
        """Whether the sizes of arrays, on which types depend, name data of these folded names."""
        sizes = (_names_in(item.dimensions) for item in self._check.values)
        return any(not names.isdisjoint(used) for used in sizes)

    def _check_values(self, values: Mapping[tree.Data, tree.Module]) -> None:
        """Check the values of data outside of routines again, by data with their modules."""
        with deep_recursion():
            for item, module in values.items():
                nodes = _nodes_of_value(item)
                for node in nodes:
                    self._facts.memo.pop(node, None)
                self._check.forget_nodes(nodes)
                self._check.check_data(item, module)
            self._check.check_circles()

    def _heads(self, modules: set[tree.Module]) -> list[ProgramPart]:
        """The parts of modules outside of their routines."""
        return [
            part for part in self._facts.parts if part.routine is None and part.module in modules
        ]

    def _is_plain(self, item: tree.Item, module: tree.Module) -> bool:
        """Whether the declaration of an item depends on nothing but declared types."""
        types = self._check.types
        if isinstance(item, tree.Data):
            return not item.dimensions and types.resolves(item.type.key, module)
        if not isinstance(item, tree.Routine):
            return isinstance(item, tree.InvalidStatement)
        named = [
            node.type.key
            for node in descendants(item)
            if isinstance(node, tree.Data | tree.ParameterDeclaration | tree.Func)
        ]
        found = self._check.declarations.diagnostics
        spans = [one.span for one in found if one.span and one.span.source is module.source]
        return all(types.resolves(key, module) for key in named) and not any(
            item.start <= span.start < item.end for span in spans
        )

    def _users_of(
        self, users: dict[tree.Data, tree.Module], names: set[str]
    ) -> dict[tree.Data, tree.Module]:
        """Data of modules whose values depend on names, with their modules.

        Args:
            users: Data that are known to depend on them.
            names: The folded names.
        """
        users, names = dict(users), set(names)
        uses = [
            (item, home, _names_in((item.value,)))
            for home in self._check.modules
            for item in home.items
            if isinstance(item, tree.Data) and item.value is not None
        ]
        while True:
            using = {item: home for item, home, used in uses if not names.isdisjoint(used)}
            if using.keys() <= users.keys():
                return users
            users |= using
            names |= {item.name.key for item in using}

    def _conclude(
        self,
        path: str,
        again: Mapping[tree.Routine, tree.Module],
        changed: Iterable[ProgramPart] = (),
    ) -> bool:
        """Check routines, decide undeclared names, and renew the facts; see `_recheck`.

        Args:
            path: The file whose text changed.
            again: The routines, which are forgotten, with their modules.
            changed: Parts without routines that changed.
        """
        check = self._check
        with deep_recursion():
            for routine, module in again.items():
                check.check_routine(routine, module)
            decided = check.decide()
        if None in decided or len(check.analysis.nearest) >= MOST_COMPARED:
            return False
        self._trees[path] = self._units[path].file
        part_of = self._facts.part_of
        parts = [part_of[one] for one in {*again, *decided} if one is not None]
        self._facts = self._facts.renewed(tuple(self._trees.values()), (*changed, *parts))
        return True

    def _forget(self, part: ProgramPart) -> None:
        """Remove what is known of the body of a routine."""
        assert part.routine is not None
        nodes = [one for kind, found in part.nodes.items() if kind not in _HEADERS for one in found]
        self._check.forget(part.routine, nodes)
        for node in nodes:
            self._facts.memo.pop(node, None)

    def _depends_on_unread(self, unit: UnitResults) -> bool:
        """Whether the unread text answers a question of a unit differently than before."""
        return any(
            self._check.analysis.is_unread(key) != answer for key, answer in unit.unread.items()
        )

    def _is_of_known_types(self, edited: EditedRoutine) -> bool:
        """Whether all local data have declared types; the task shares the shapes of others."""
        bodies = (*clauses(edited.routine), *clauses(edited.replacement))
        return all(
            self._check.types.resolves(node.type.key, edited.module)
            for node in statements(*bodies)
            if isinstance(node, tree.Data)
        )

    def _collect(self, edited: str | None = None) -> frozenset[str]:
        """Sort all findings by file.

        Args:
            edited: The file whose text changed; None for all.

        Returns:
            The paths of files whose findings changed, or places that they name.
        """
        of_syntax = [one for units in self._units.values() for one in units.diagnostics]
        with deep_recursion():
            of_rules = list(self._rules.in_task(self._facts))
        found = [*self._check.diagnostics(), *of_rules]
        raw: dict[str, list[Diagnostic]] = {path: [] for path in self._units}
        first = next(iter(raw))
        for one in (*of_syntax, *without_guesses(found, of_syntax, tuple(self._trees.values()))):
            raw[one.span.file if one.span else first].append(one)
        changed = frozenset(
            path
            for path, listed in raw.items()
            if path == edited or listed != self._raw.get(path) or _names(listed, edited)
        )
        for path in changed:
            self._findings.pop(path, None)
        self._raw = raw
        return changed


def _nodes_of_value(data: tree.Data) -> list[tree.Node]:
    return [] if data.value is None else list(descendants(data.value))


def _names_in(expressions: Iterable[tree.Expression]) -> set[str]:
    """Folded names of data in expressions."""
    return {
        node.name.key for node in descendants(*expressions) if isinstance(node, tree.DataReference)
    }


def _names(findings: Sequence[Diagnostic], path: str | None) -> bool:
    """Whether findings name places in a file."""
    return any(related.span.file == path for one in findings for related in one.related)
