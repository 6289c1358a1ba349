"""RAPID under pytest: a fixture for Python tests, and RAPID procedures that are tests themselves.

pytest loads it where rapidsim is installed. The fixture `rapid` loads cells whose home folder is
fresh for each test, `controller` serves them to clients. A module `test_*.mod` is collected: each
of its procedures `test_*` without required parameters runs like a `main`, together with the modules
of its folder that are not tests and the modules of the setting `rapid_modules`. It passes if it
runs to its end.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from rapidsim.api.cell import Cell
    from rapidsim.api.run import Run
    from rapidsim.diagnostics import Diagnostic
    from rapidsim.motion.robot.robot import Robot

_WIDTH = 100
_PATIENCE_S = 30.0
"""Time [s] that a served controller has to end."""
_TEST = "test_"


def pytest_addoption(parser: pytest.Parser) -> None:
    """The settings of RAPID tests."""
    parser.addini(
        "rapid_modules", "RAPID modules and folders that every test_*.mod is run with", "paths"
    )
    parser.addini("rapid_robot", "the arm of RAPID tests, where no station file names one")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> RapidFile | None:
    """Collect `test_*.mod` and its like."""
    from rapidsim.module_files import MODULE_SUFFIXES

    if file_path.suffix.lower() not in MODULE_SUFFIXES:
        return None
    if not file_path.name.lower().startswith(_TEST):
        return None
    return RapidFile.from_parent(parent, path=file_path)


class Rapid:
    """The fixture `rapid`: cells, each with its own home folder."""

    def __init__(self, folder: Path, home: Path) -> None:
        """Name the folder that paths begin in, and the home folder."""
        self._folder = folder
        self.home = home
        """The folder for HOME: of the programs."""

    def load(
        self,
        paths: str | PathLike[str] | Iterable[str | PathLike[str]],
        *,
        robot: Robot | str | None = None,
        station: str | PathLike[str] | None = None,
        task: str | None = None,
    ) -> Cell:
        """Load a program as `rapidsim.load` does; paths begin in the folder of the test."""
        from rapidsim.api.cell import load

        named = [paths] if isinstance(paths, str | PathLike) else list(paths)
        found = [self._folder / path for path in named]
        where = None if station is None else self._folder / station
        return load(found, robot=robot, station=where, task=task, home=self.home)


@pytest.fixture
def rapid(request: pytest.FixtureRequest, tmp_path: Path) -> Rapid:
    """Cells whose home folder is fresh: `rapid.load("cell/").run()`, `.call("area", 2, 3)`."""
    home = tmp_path / "home"
    home.mkdir()
    return Rapid(request.path.parent, home)


class ServedController:
    """A controller served by `rapidsim serve` in a separate process."""

    def __init__(self, arguments: list[str], folder: Path, log: Path) -> None:
        """Start it, and wait until it listens; its error output goes to a file."""
        self._log = log
        with log.open("w", encoding="utf-8") as errors:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "rapidsim", "serve", *arguments],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
            )
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            self.end()
            pytest.fail(f"rapidsim serve did not start:\n{self.errors}", pytrace=False)
        ready = json.loads(line)
        self.rws1: str = ready["rws1"]
        """Address of Robot Web Services 1.0: `http://127.0.0.1:PORT`."""
        self.rws2: str | None = ready["rws2"]
        """Address of Robot Web Services 2.0; needs `--rws2-port 0`."""
        self.faults: str = ready["faults"]
        """Address at which faults begin and end."""
        self.debug: str | None = ready.get("debug")
        """Address at which a debugger attaches: `127.0.0.1:PORT`; needs `--debug 0`."""
        self.home = Path(ready["home"])
        """The folder of HOME:."""
        self.ramdisk = Path(ready["ramdisk"])
        """The folder of RAMDISK:."""

    @property
    def errors(self) -> str:
        """The error output so far: errors of programs, notes."""
        return self._log.read_text(encoding="utf-8")

    def fail(self, kind: str, **keys: object) -> None:
        """Let it fail now, or when the keys say: `fail("drop", on="http", count=2, for_=3.0)`.

        The keys are those of [[fault]] in a station file, `for_` stands for `for`.

        Raises:
            ValueError: If they are no fault; the message is the controller's.
        """
        fault = {"kind": kind, **{name.rstrip("_"): value for name, value in keys.items()}}
        self._request("POST", json.dumps(fault).encode())

    def end_faults(self) -> None:
        """End the faults that last: an emergency stop is released, connections work again."""
        self._request("DELETE", None)

    def _request(self, method: str, body: bytes | None) -> None:
        from http.client import HTTPConnection

        connection = HTTPConnection(self.faults.rpartition("/")[2], timeout=_PATIENCE_S)
        try:
            connection.request(method, "/faults", body)
            response = connection.getresponse()
            text = response.read().decode().strip()
        finally:
            connection.close()
        if response.status >= 400:
            raise ValueError(text)

    def end(self) -> int:
        """End it, so that its journal is whole; its exit code."""
        self._process.terminate()
        try:
            return self._process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()
        finally:
            assert self._process.stdout is not None
            self._process.stdout.close()


@pytest.fixture
def controller(
    request: pytest.FixtureRequest, tmp_path: Path
) -> Iterator[Callable[..., ServedController]]:
    """Controllers for clients: `controller("cell/", "--lock-step").rws1` is the address of one.

    The paths, of which the first arguments are, begin in the folder of the test; options are those
    of `rapidsim serve`. Each listens at a free port, has a fresh home folder, and ends with the
    test.
    """
    served: list[ServedController] = []

    def serve(*arguments: str | PathLike[str]) -> ServedController:
        name = f"controller-{len(served) + 1}"
        home = tmp_path / name
        home.mkdir()
        own = ["--rws1-port", "0", "--rws2-port", "off", "--home", str(home)]
        own += ["--faults-port", "0"]
        given = [str(one) for one in arguments]
        served.append(
            ServedController([*own, *given], request.path.parent, tmp_path / f"{name}.log")
        )
        return served[-1]

    yield serve
    for one in served:
        one.end()


class RapidFailedError(Exception):
    """A RAPID test that did not finish."""

    def __init__(self, findings: tuple[Diagnostic, ...], end: str) -> None:
        """Carry what was found."""
        super().__init__(findings, end)
        self.findings = findings
        self.end = end

    def __str__(self) -> str:
        """The findings with their places, and the routines that called."""
        from rapidsim.report.findings.merging import merged
        from rapidsim.report.findings.text import full
        from rapidsim.report.palette import Palette

        text = full(merged(self.findings), Palette(), width=_WIDTH).rstrip()
        return text or f"the procedure did not finish: {self.end}"


class RapidFile(pytest.File):
    """A module of RAPID tests."""

    def collect(self) -> Iterator[RapidTest]:
        """Its procedures `test_*` that can be called without arguments."""
        from rapidsim.diagnostics import Source
        from rapidsim.files import decode, input_bytes
        from rapidsim.syntax import tree
        from rapidsim.syntax.parser import parse

        text, _ = decode(input_bytes(self.path))
        for module in parse(Source(str(self.path), text)).file.modules:
            for routine in module.routines:
                is_test = routine.name.text.lower().startswith(_TEST)
                if is_test and isinstance(routine, tree.Proc):
                    yield RapidTest.from_parent(self, name=routine.name.text)


class RapidTest(pytest.Item):
    """A procedure that is a test."""

    def runtest(self) -> None:
        """Run it."""
        run = self._run()
        errors = tuple(one for one in run.diagnostics if one.severity == "error")
        if run.end != "ended" or not run.ok:
            raise RapidFailedError(errors or run.diagnostics[-1:], run.headline)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], *_: Any) -> str:
        """The message for RAPID users, without Python's traceback."""
        from rapidsim.files import InputError
        from rapidsim.jobs.running.run_files import ProgramRejectedError

        match excinfo.value:
            case ProgramRejectedError(diagnostics=found):
                return str(
                    RapidFailedError(tuple(one for one in found if one.severity == "error"), "")
                )
            case InputError(message=message, help=cure):
                return f"{message}\n help: {cure}" if cure else message
            case RapidFailedError() as failed:
                return str(failed)
            case _:
                return str(super().repr_failure(excinfo))

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """The location of the test."""
        return self.path, None, f"PROC {self.name}"

    def _run(self) -> Run:
        from tempfile import TemporaryDirectory

        from rapidsim.api.cell import load

        paths = [self.path, *_sibling_modules(self.path), *self.config.getini("rapid_modules")]
        with TemporaryDirectory(prefix="rapidsim-") as home:
            robot = self.config.getini("rapid_robot") or None
            return load(paths, robot=robot, home=home).run(proc=self.name)


def _sibling_modules(file: Path) -> list[Path]:
    """The modules of its folder that are no tests."""
    from rapidsim.module_files import MODULE_SUFFIXES

    return sorted(
        one
        for one in file.parent.iterdir()
        if one.suffix.lower() in MODULE_SUFFIXES and not one.name.lower().startswith(_TEST)
    )
