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
            "tests/lsp/test_lsp_names.py",
            "tests/simulation/test_simulation_backup_modules.py",
            "tests/simulation/test_simulation_reach_flow.py",
            "tests/workspace",
        ),
        "collisions": ("tests/collisions",),
        "controller": ("tests/simulation", "tests/rapid", "tests/programs"),
        "interpreter": (
            "tests/check/test_check_runs.py",
            "tests/cli/test_cli_call_stack.py",
            "tests/cli/test_cli_modules.py",
            "tests/cli/test_cli_persistents.py",
            "tests/interpreter",
            "tests/limits",
            "tests/rapid",
            "tests/simulation/test_simulation_loading.py",
            # Behind a debugger nothing is counted any more.
            "tests/dap",
        ),
        "library": ("tests/library", "tests/rapid"),
        "motion": ("tests/motion", "tests/programs"),
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
        "simulation": ("tests/simulation", "tests/collisions"),
        "station": ("tests/cli", "tests/simulation"),
        "syntax": ("tests/syntax", "tests/check"),
    }
)
"""Patterns of the tests that decide about a room."""
_COVERAGE = """[run]
concurrency = thread,greenlet
dynamic_context = test_function
source = rapidsim/{room}
"""
_FIRST_TESTS = 25
"""Tests that judge a change first, the ones that execute the fewest lines first, and at last the
one that executes the most: it may hold whole answers. What they let through, all judge."""
_LIMIT_S = 900.0
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


def mutants(file: str, text: str, *, texts: bool = False) -> Iterator[Mutant]:
    """Yield all changes of a file; with `texts`, those of its texts."""
    lines = [line.encode() for line in text.splitlines(keepends=True)]
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    data = text.encode()
    for node in _nodes(ast.parse(text)):
        if node.end_lineno is None or node.end_col_offset is None:
            continue
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset
        for changed in _texts(node) if texts else _changes(node):
            after = ast.unparse(changed)
            after = f"({after})" if isinstance(changed, ast.expr) else after
            new = (data[:begin] + after.encode() + data[end:]).decode()
            yield Mutant(file, node.lineno, data[begin:end].decode(), after, new)


def _nodes(tree: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    """Yield expressions and statements, but for types, texts and messages."""
    for child in ast.iter_child_nodes(tree):
        if isinstance(child, ast.AnnAssign) and child.value is not None:
            yield from _nodes(ast.Expression(child.value))
        if isinstance(child, _SKIPPED) or _is_for_types(child) or _is_docstring(child):
            continue
        if isinstance(child, ast.FunctionDef):
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
        self.folder = folder
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
        self._run("-m", "coverage", "run", "--rcfile=coverage.ini", "-m", "pytest", *self._tests)
        self._data = CoverageData(str(folder / ".coverage"))
        self._data.read()
        self._files = {
            path.stem: path.relative_to(folder).as_posix()
            for path in (folder / "tests").rglob("test_*.py")
        }
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
        contexts = self._data.contexts_by_lineno(file_name).get(mutant.line, [])
        # What runs when a module is imported belongs to no test.
        is_executed = mutant.line in (self._data.lines(file_name) or ())
        named = sorted((name for name in contexts if name), key=self._lines.__getitem__)
        found = []
        for name in named:
            module, _, function = name.rpartition(".")
            file = self._files.get(module.rpartition(".")[2])
            if file is not None:
                found.append(f"{file}::{function}")
        return found or (self._tests if is_executed else [])

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
            return self._run("-m", "pytest", "-x", *first) != 0 or (
                len(tests) > len(first) and self._run("-m", "pytest", "-x", *tests) != 0
            )
        finally:
            file.write_text(before, encoding="utf-8")

    def _run(self, *arguments: str) -> int:
        command = [sys.executable, *arguments, "-q", "-p", "no:cacheprovider", "-p", "no:xdist"]
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
