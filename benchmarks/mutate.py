"""Change single nodes of the code, and say which changes no test notices.

    python benchmarks/mutate.py collisions --count 40 --seed 1
    python benchmarks/mutate.py server --files 'rapidsim/server/resources/*.py' --texts

Comparisons, arithmetic, conditions, whole numbers and calls are changed one at a time, in a copy of
the repository, or with `--texts` texts, such as fields of answers; tolerances, and on which side
equality lies, decide little. A first run of the
room's tests says which of them execute which line; a changed line is judged by these. What survives
is printed; some of it is equivalent, which is for a person to say.
"""

from __future__ import annotations

import argparse
import ast
import copy
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from coverage import CoverageData

ROOT = Path(__file__).parents[1]
ROOMS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "analysis": (
            "tests/analysis",
            "tests/check",
            "tests/interpreter/test_interpreter_constants.py",
            "tests/lsp/test_lsp_names.py",
            "tests/simulation/test_simulation_backup_modules.py",
            "tests/simulation/test_simulation_reach_flow.py",
            "tests/workspace",
        ),
        "collisions": ("tests/collisions",),
        "controller": (
            "tests/controller",
            "tests/simulation",
            "tests/rapid",
            "tests/programs",
            # What a run says of the example of each rule.
            "tests/check/test_check_rules.py",
            "tests/limits/test_limits_of_time.py",
        ),
        "interpreter": (
            "tests/check/test_check_runs.py",
            "tests/cli/test_cli_assert.py",
            "tests/cli/test_cli_call_stack.py",
            "tests/cli/test_cli_modules.py",
            "tests/cli/test_cli_persistents.py",
            "tests/interpreter",
            "tests/limits",
            "tests/rapid",
            "tests/simulation/test_live_steps.py",
            "tests/simulation/test_simulation_error*.py",
            "tests/simulation/test_simulation_loading.py",
            "tests/simulation/test_simulation_runs.py",
            "tests/simulation/test_simulation_shared_types.py",
            "tests/simulation/test_simulation_tasks.py",
            # Behind a debugger nothing is counted any more.
            "tests/dap",
        ),
        "library": (
            "tests/library",
            "tests/rapid",
            "tests/simulation/test_simulation_guidance*.py",
            "tests/simulation/test_simulation_home_programs.py",
            "tests/simulation/test_simulation_loading.py",
            "tests/simulation/test_simulation_sockets.py",
            "tests/simulation/test_simulation_tasks*.py",
            "tests/simulation/test_simulation_text_tables.py",
        ),
        "motion": (
            "tests/motion",
            "tests/programs",
            "tests/plots/test_plots_followed.py",
            "tests/simulation/test_live_jogging.py",
            "tests/simulation/test_simulation_belts.py",
            "tests/simulation/test_simulation_guidance*.py",
            "tests/simulation/test_simulation_path_correction.py",
            "tests/simulation/test_simulation_reach_cures.py",
        ),
        "reach": (
            "tests/check",
            "tests/cli/test_cli_best_arm.py",
            "tests/cli/test_cli_check_reach.py",
            "tests/cli/test_cli_sweep.py",
            "tests/collisions/test_collisions_check.py",
            "tests/simulation/test_simulation_first_errors.py",
            "tests/simulation/test_simulation_impossible_moves.py",
            "tests/simulation/*_reach_*.py",
            "tests/simulation/test_simulation_wrist_circle.py",
        ),
        "server": ("tests/server",),
        "simulation": (
            "tests/simulation",
            "tests/collisions",
            "tests/report/test_report_verdict.py",
        ),
        "station": (
            "tests/station",
            "tests/cli/test_cli_init.py",
            "tests/cli/test_cli_station.py",
            "tests/simulation/test_simulation_backup*.py",
            "tests/simulation/test_simulation_cells.py",
            "tests/simulation/test_simulation_external_axes.py",
            "tests/simulation/test_simulation_signals.py",
            "tests/simulation/test_simulation_tasks.py",
            "tests/simulation/test_simulation_station_page.py",
            "tests/collisions/test_collisions_link_meshes.py",
        ),
        "syntax": ("tests/syntax", "tests/check"),
    }
)
"""Patterns of the tests that decide about a room."""
_COVERAGE = """[run]
concurrency = thread,greenlet
source = rapidsim/{room}
"""
_PLUGIN = "contexts_of_tests"
_CONTEXTS = """import sys

import coverage
import pytest


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item):
    measured = coverage.Coverage.current()
    if measured is not None:
        measured.switch_context(item.nodeid.partition("[")[0])
    tracer = sys.gettrace()
    try:
        return (yield)
    finally:
        if sys.gettrace() is not tracer:
            sys.settrace(tracer)
"""
"""Not by the names of functions: that which executes a law of Hypothesis is called a test, too.

The tracer of the measurement is put back behind a test of a debugger, which ends with none.
"""
_FIRST_TESTS = 25
"""Tests that judge a change first, the ones that execute the fewest lines first, and at last the
one that executes the most: it may hold whole answers. What they let through, all judge."""
_LISTS = ROOT.parent / "shared"
"""Lists that few tests compare with, beside the repository."""
_UNTRACED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"controller": ("tests/simulation/test_simulation_runs.py",)}
)
"""Tests of what a room does only where nothing traces it: moves in columns."""
_LIMIT_S = 900.0
_NO_TESTS = 5
"""What pytest returns if it has executed none."""
_OPPOSITES: Mapping[type[ast.AST], tuple[type[ast.AST], ...]] = MappingProxyType(
    {
        ast.Lt: (ast.GtE,),
        ast.LtE: (ast.Gt,),
        ast.Gt: (ast.LtE,),
        ast.GtE: (ast.Lt,),
        ast.Eq: (ast.NotEq,),
        ast.NotEq: (ast.Eq,),
        ast.Is: (ast.IsNot,),
        ast.IsNot: (ast.Is,),
        ast.In: (ast.NotIn,),
        ast.NotIn: (ast.In,),
        ast.Add: (ast.Sub,),
        ast.Sub: (ast.Add,),
        ast.Mult: (ast.Div,),
        ast.Div: (ast.Mult,),
        ast.FloorDiv: (ast.Mult,),
        ast.Mod: (ast.FloorDiv,),
        ast.And: (ast.Or,),
        ast.Or: (ast.And,),
    }
)
_SKIPPED = (ast.AnnAssign, ast.arg, ast.JoinedStr, ast.Import, ast.ImportFrom, ast.Raise)


@dataclass(frozen=True)
class Mutant:
    """A changed node."""

    file: str
    line: int
    before: str
    after: str
    text: str
    """The whole file."""
    statement: range
    """Lines of the smallest statement around it, of a compound one those of its head."""


def mutants(file: str, text: str, *, texts: bool = False) -> Iterator[Mutant]:
    """Yield all changes of a file; with `texts`, those of its texts."""
    lines = [line.encode() for line in text.splitlines(keepends=True)]
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    data = text.encode()
    tree = ast.parse(text)
    statements = _statements(tree)
    for node in _nodes(tree):
        if node.end_lineno is None or node.end_col_offset is None:
            continue
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset
        for changed in _texts(node) if texts else _changes(node):
            after = ast.unparse(changed)
            after = f"({after})" if isinstance(changed, ast.expr) else after
            new = (data[:begin] + after.encode() + data[end:]).decode()
            line, before = node.lineno, data[begin:end].decode()
            own = range(line, line + 1)
            yield Mutant(file, line, before, after, new, statements.get(line, own))


def _statements(tree: ast.Module) -> dict[int, range]:
    """Return the lines of the smallest statement around each line."""
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt):
            body = getattr(node, "body", None)
            begin = min([node.lineno, *(o.lineno for o in getattr(node, "decorator_list", ()))])
            end = body[0].lineno - 1 if body else node.end_lineno or node.lineno
            lines = range(begin, max(end, node.lineno) + 1)
            found.update(dict.fromkeys(lines, lines))
    return found


def _nodes(tree: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    """Yield expressions and statements, but for types, texts, messages and decorators."""
    for child in ast.iter_child_nodes(tree):
        if isinstance(child, ast.AnnAssign) and child.value is not None:
            yield from _nodes(ast.Expression(child.value))
        if isinstance(child, _SKIPPED) or _is_for_types(child) or _is_docstring(child):
            continue
        # Of sequences that are as long as each other, it only says so.
        if isinstance(child, ast.keyword) and child.arg == "strict":
            continue
        if isinstance(child, ast.FunctionDef | ast.ClassDef):
            # What decorates a class, such as slots, decides its cost.
            for statement in child.body:
                yield from _nodes(ast.Module([statement], []))
            continue
        if isinstance(child, ast.expr | ast.stmt):
            yield child
        yield from _nodes(child)


def _is_for_types(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _texts(node: ast.expr | ast.stmt) -> Iterator[ast.expr]:
    match node:
        case ast.Constant(value=str(value)) if value:
            yield ast.Constant(f"{value}Q")
        case _:
            return


def _changes(node: ast.expr | ast.stmt) -> Iterator[ast.expr | ast.stmt]:
    changed = copy.copy(node)
    match node, changed:
        case ast.Compare(ops=[operator]), ast.Compare():
            for other in _OPPOSITES.get(type(operator), ()):
                yield ast.Compare(node.left, [other()], node.comparators)  # type: ignore[list-item]
        case (ast.BinOp(op=op), ast.BinOp()) | (ast.BoolOp(op=op), ast.BoolOp()):
            for other in _OPPOSITES.get(type(op), ()):
                changed.op = other()  # type: ignore[union-attr, assignment]
                yield changed
            if isinstance(op, ast.Pow):
                yield ast.BinOp(changed, ast.Mult(), node.left)  # type: ignore[arg-type, union-attr]
        case ast.UnaryOp(op=ast.Not() | ast.USub(), operand=operand), _:
            yield operand
        case ast.IfExp(test=test, body=body, orelse=other), _:
            yield ast.IfExp(test, other, body)
        case ast.Constant(value=bool(value)), _:
            yield ast.Constant(not value)
        case ast.Constant(value=int(value)), _:
            yield ast.Constant(value + 1)
        case ast.Expr(value=ast.Call()), _:
            yield ast.Pass()
        case _:
            return


class Copy:
    """A copy of the repository, in which tests run."""

    def __init__(self, folder: Path, room: str) -> None:
        """Copy what tests need, and learn which of the room's execute which line."""
        self.folder = folder = folder / "copy"
        folder.mkdir()
        if _LISTS.is_dir():
            (folder.parent / _LISTS.name).symlink_to(_LISTS)
        self._untraced = list(_UNTRACED.get(room, ()))
        self._tests = [
            found.relative_to(ROOT).as_posix()
            for pattern in ROOMS[room]
            for found in sorted(ROOT.glob(pattern))
        ]
        listed = subprocess.run(
            ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True
        )
        for name in listed.stdout.decode().split("\0"):
            if name and (ROOT / name).is_file():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ROOT / name, folder / name)
        (folder / "coverage.ini").write_text(_COVERAGE.format(room=room), encoding="utf-8")
        (folder / f"{_PLUGIN}.py").write_text(_CONTEXTS, encoding="utf-8")
        measured = ("-m", "coverage", "run", "--rcfile=coverage.ini", "-m", "pytest")
        self._run(*measured, "-p", _PLUGIN, *self._tests)
        failed = folder / ".pytest_cache" / "v" / "cache" / "lastfailed"
        self._failed = set[str]()
        # What fails without a change, and not for being traced, kills nothing.
        found = json.loads(failed.read_text()) if failed.is_file() else {}
        self._failed = {one for one in sorted(found) if self._fails([one])}
        for one in sorted(self._failed):
            print(f"fails without a change: {one}")
        self._data = CoverageData(str(folder / ".coverage"))
        self._data.read()
        contexts = Counter(
            context
            for file in self._data.measured_files()
            for found in self._data.contexts_by_lineno(file).values()
            for context in found
        )
        self._lines = contexts

    def tests(self, mutant: Mutant) -> list[str]:
        """Return the tests that execute a line, those of few lines first; empty if none does."""
        file_name = str(self.folder / mutant.file)
        seen = self._data.contexts_by_lineno(file_name)
        # A line of constants within a longer statement leaves no trace of its own.
        lines = (mutant.line,) if mutant.line in seen else mutant.statement
        contexts = {name for line in lines for name in seen.get(line, ())}
        # What runs when a module is imported belongs to no test.
        is_executed = any(line in seen for line in lines)
        named = sorted((name for name in contexts if name), key=lambda one: (self._lines[one], one))
        return named or (self._tests if is_executed else self._untraced)

    def kills(self, mutant: Mutant) -> bool:
        """Whether a test notices a change."""
        tests = self.tests(mutant)
        if not tests:
            return False
        first = [*tests[: _FIRST_TESTS - 1], *tests[_FIRST_TESTS - 1 :][-1:]]
        file = self.folder / mutant.file
        before = file.read_text(encoding="utf-8")
        file.write_text(mutant.text, encoding="utf-8")
        try:
            return self._fails(first) or (len(tests) > len(first) and self._fails(tests))
        finally:
            file.write_text(before, encoding="utf-8")

    def _fails(self, tests: Sequence[str]) -> bool:
        return self._run("-m", "pytest", "-x", *tests) not in (0, _NO_TESTS)

    def _run(self, *arguments: str) -> int:
        command = [sys.executable, *arguments, "-q", "-p", "no:xdist"]
        if "-x" in arguments:
            deselected = (part for one in self._failed for part in ("--deselect", one))
            command += ["-p", "no:cacheprovider", *deselected]
        environment = {**os.environ, "PYTHONPATH": str(self.folder), "RAPIDSIM_NO_CACHE": "1"}
        try:
            done = subprocess.run(
                command,
                cwd=self.folder,
                env=environment,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=_LIMIT_S if "-x" in arguments else None,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return -1
        return done.returncode


def campaign(room: str, files: Sequence[str], count: int, seed: int, *, texts: bool) -> None:
    """Try some changes of a room, and print what survives."""
    found = [
        one
        for file in files
        for one in mutants(file, (ROOT / file).read_text("utf-8"), texts=texts)
    ]
    chosen = random.Random(seed).sample(found, min(count, len(found)))
    with tempfile.TemporaryDirectory() as name:
        repository = Copy(Path(name), room)
        tried, survived, unseen, begin = 0, 0, 0, time.monotonic()
        try:
            for mutant in chosen:
                is_killed = repository.kills(mutant)
                tried += 1
                if is_killed:
                    continue
                survived += 1
                is_seen = bool(repository.tests(mutant))
                unseen += not is_seen
                note = "" if is_seen else "  (no test of the room executes it)"
                print(f"{mutant.file}:{mutant.line}: {mutant.before} -> {mutant.after}{note}")
                sys.stdout.flush()
        finally:
            # Also of a campaign that is stopped.
            share = 100.0 * (1.0 - survived / max(1, tried))
            print(
                f"{room}, seed {seed}: {tried} of {len(found)} changes, {share:.0f} % die,"
                f" {survived} survive, {unseen} of them on lines that no test of the room executes;"
                f" {time.monotonic() - begin:.0f} s",
                flush=True,
            )


def main() -> None:
    """Change and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("room", choices=ROOMS)
    parser.add_argument("--files", nargs="*", help="patterns; by default all of the room")
    parser.add_argument("--texts", action="store_true", help="change texts")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    request = parser.parse_args()
    patterns = request.files or [f"rapidsim/{request.room}/**/*.py"]
    files = sorted({p.relative_to(ROOT).as_posix() for one in patterns for p in ROOT.glob(one)})
    campaign(request.room, files, request.count, request.seed, texts=request.texts)


if __name__ == "__main__":
    main()
