"""What all tests share: the mark `process`, tools first, laws that find the same each time,
programs of rules.
"""

import gc
import os
from collections.abc import Generator
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

import pytest
from command_line import PROCESS, SWITCH
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers
from laws import PROFILE

from rapidsim.diagnostics import all_rules
from rapidsim.report.pages.rules import programs

# Matrices are small, and the tests have a process a core: more threads only wait for each other.
# NumPy reads it when it is loaded, which no import above does; processes that tests start get it.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Compiling loops takes seconds in each process, and once it is done short batches go through them
# too, in all tests that follow. The tests of compiled loops compare them with these, on purpose.
os.environ.setdefault("RAPIDSIM_NUMBA", "0")

# What a test finds must not come from an earlier run; the tests of results that are kept use
# folders of their own.
os.environ.setdefault("RAPIDSIM_NO_CACHE", "1")

# A test makes garbage by the hundred thousand, nearly all of it without circles.
gc.set_threshold(10_000, 20, 20)
_COLLECTED_EVERY = 100
_TESTS = count(1)

# No deadline and no verdict about slow examples: machines differ, and so do their loads.
# Derandomised and without memory: a run must not fail for luck, nor for what stands in somebody's
# folder. How many cases, see `laws`; to look for new ones, HYPOTHESIS_PROFILE=explore.
settings.register_profile(
    "ci",
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile("fast", settings.get_profile("ci"), max_examples=8)
settings.register_profile("explore", deadline=None, max_examples=500)
settings.load_profile(PROFILE)
if PROFILE != "explore":
    # Hypothesis also tries constants of the modules that are loaded: with them the cases of a law
    # would depend on which tests have run before.
    providers._get_local_constants = lambda: providers._local_constants

COMPILED = "RAPIDSIM_TESTS_COMPILED"
"""The variable that tells the processes of the suite where compiled modules go."""

# Files with tests of seconds; the tools first, for mypy takes longer than all others.
LONGEST = {
    name: place
    for place, name in enumerate(
        (
            "test_tidy.py",
            "test_motion_line_rates.py",
            "test_simulation_every_program.py",
            "test_docs_snippets.py",
            "test_simulation_calibration.py",
            "test_limits_of_texts.py",
            "test_cli_sweep.py",
            "test_cli_seen_arms.py",
            "test_simulation_other_machines.py",
            "test_simulation_joint_logger.py",
        )
    )
}


def pytest_configure(config: pytest.Config) -> None:
    """Who wants no compiled modules beside the sources gets them elsewhere for what tests start.

    Else each of these processes compiles all that it imports. They share a folder, whichever worker
    starts them. Those that run tests read what is compiled beside the packages, and compile the
    rest in memory: that is quicker than all anew.
    """
    if not os.environ.get("PYTHONDONTWRITEBYTECODE"):
        return
    if COMPILED not in os.environ:
        folder = TemporaryDirectory(prefix="rapidsim-tests-", ignore_cleanup_errors=True)
        config.add_cleanup(folder.cleanup)
        os.environ[COMPILED] = folder.name
    if not config.getoption("numprocesses", None):
        del os.environ["PYTHONDONTWRITEBYTECODE"]
        os.environ["PYTHONPYCACHEPREFIX"] = os.environ[COMPILED]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """No fixture: thousands of tests would set it up for nothing."""
    if next(_TESTS) % _COLLECTED_EVERY == 0:
        # Garbage of programs goes; what stays is not looked at again.
        gc.collect()
        gc.freeze()
    if not item.get_closest_marker("process"):
        return (yield)
    with patch.dict(os.environ, {SWITCH: PROCESS}):
        return (yield)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What takes long starts first: at the end no process runs alone."""
    items.sort(key=lambda item: LONGEST.get(item.path.name, len(LONGEST)))


def pytest_collection_finish() -> None:
    """What all tests have imported stays to the end: no collection of garbage looks at it again."""
    gc.freeze()


@pytest.fixture(scope="session")
def rule_programs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Every program of every rule's folder, as a file of its own."""
    folder = tmp_path_factory.mktemp("rules")
    files = []
    for rule in all_rules():
        for kind in ("bad", "good"):
            for number, program in enumerate(programs(rule, f"{kind}.mod")):
                if program:
                    files.append(folder / f"{rule.code}-{kind}-{number}.mod")
                    files[-1].write_bytes(program)
    return files
