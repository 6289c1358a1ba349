"""Starting fast: a command imports what it needs and no more. And the public names exist."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import rapidsim

HEAVY = ("rerun", "yourdfpy", "trimesh", "scipy", "pyarrow", "networkx", "matplotlib", "numba")
THREADS = Path("/proc/self/task")
MODULE = "MODULE tiny\n  PROC main()\n    VAR num n;\n    n:=1;\n  ENDPROC\nENDMODULE\n"

REPORT = """
import json, sys
from rapidsim.cli.boundary import run_commands
code = run_commands(sys.argv[1:])
print(json.dumps([code, sorted(name for name in sys.modules if "." not in name)]))
"""


def imported(*arguments: str, cwd: Path) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", REPORT, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=True,
    )
    code, modules = json.loads(done.stdout.splitlines()[-1])
    assert code == 0, done.stderr
    return set(modules)


@pytest.mark.process
@pytest.mark.parametrize(
    ("arguments", "forbidden"),
    [
        (("--version",), (*HEAVY, "numpy", "rich", "lark")),
        (("--help",), (*HEAVY, "numpy", "rich", "lark")),
        (("check", "tiny.mod"), (*HEAVY, "numpy", "rich", "lark")),
        (("check", "tiny.mod", "--robot", "irb120"), (*HEAVY, "rich", "lark")),
        (("robots",), (*HEAVY, "lark")),
        (("explain", "N201"), (*HEAVY, "numpy", "rich", "lark")),
        (("frames", "tiny.mod"), (*HEAVY, "lark")),
        (("run", "tiny.mod", "--no-record"), (*HEAVY, "lark", "coverage", "pdb", "cProfile")),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) and value[0] not in HEAVY else "",
)
def test_a_command_imports_what_it_needs(
    arguments: tuple[str, ...], forbidden: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "tiny.mod").write_text(MODULE)
    assert imported(*arguments, cwd=tmp_path).isdisjoint(forbidden)


@pytest.mark.process
def test_a_station_of_signals_needs_no_arrays(tmp_path: Path) -> None:
    (tmp_path / "tiny.mod").write_text(MODULE)
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndo1 = { type = "do" }\n')
    assert imported("check", "tiny.mod", cwd=tmp_path).isdisjoint((*HEAVY, "numpy", "lark"))


def test_a_check_that_finds_nothing_reads_of_no_rule(tmp_path: Path) -> None:
    (tmp_path / "tiny.mod").write_text(MODULE)
    count = "diagnostics._rule_folders.cache_info().currsize"
    asked = f"{REPORT}from rapidsim import diagnostics\nprint({count} > 0)"
    read = [
        subprocess.run(
            [sys.executable, "-c", asked, "check", *arguments, "tiny.mod"],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
        ).stdout.splitlines()[-1]
        for arguments in ((), ("--select", "unused-data"))
    ]
    assert read == ["False", "True"]


@pytest.mark.process
@pytest.mark.skipif(not THREADS.is_dir(), reason="only Linux lists the threads of a process there")
def test_a_run_has_one_thread(tmp_path: Path) -> None:
    (tmp_path / "tiny.mod").write_text(MODULE)
    counting = f"{REPORT}import os\nprint(len(os.listdir({str(THREADS)!r})))"
    done = subprocess.run(
        [sys.executable, "-c", counting, "run", "tiny.mod", "--no-record", "--robot", "irb120"],
        cwd=tmp_path,
        env={name: one for name, one in os.environ.items() if name != "OPENBLAS_NUM_THREADS"},
        capture_output=True,
        text=True,
        check=True,
    )
    *_, modules, count = done.stdout.splitlines()
    assert "numpy" in json.loads(modules)[1]
    assert count == "1"


@pytest.mark.parametrize("name", rapidsim.__all__)
def test_public_names_exist(name: str) -> None:
    assert getattr(rapidsim, name) is not None
    assert name in dir(rapidsim)


def test_other_names_do_not() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        rapidsim.nonsense  # noqa: B018 - The access is the test.


@pytest.mark.process
def test_importing_the_package_imports_nothing_else() -> None:
    code = "import sys, rapidsim; print([m for m in sys.modules if m.startswith('rapidsim.')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
