"""What people install: wheel and source archive in fresh environments, from another folder.

Each environment takes many seconds, so these tests run behind the others.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from mypy_command import MYPY

from rapidsim.extras import EXTRAS

pytestmark = pytest.mark.packages

ROOT = Path(__file__).parents[2]
WHEEL_MB, CORE_MB, ALL_MB = 8, 130, 1450
"""Sizes of the wheel, and of environments with the core and with `all`, pip left out."""
SOURCES_MB = 100
"""Size of that with the core before Python compiles anything."""
PYTHONS = ("3.11", "3.12", "3.13")
SYSTEMS = {
    "linux": ["manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux2014_x86_64"],
    "macos": ["macosx_14_0_arm64"],
    "windows": ["win_amd64"],
}
USER_PROGRAM = '''"""How long a program takes on two arms."""
from pathlib import Path

import rapidsim

for name in ("irb120", "irb1600"):
    run = rapidsim.load(Path("pentagon.mod"), robot=name).run(max_time_s=60.0)
    moves: int = len(run.moves)
    print(f"{name}: {run.time_s:.3f} s, {moves} moves, {run.waits[0].awaited if run.waits else ''}")
'''


PIP = (sys.executable, "-m", "pip")
"""The one of the tests, which installs into other environments as well."""


@dataclass(frozen=True)
class Environment:
    folder: Path
    has_pip: bool

    @property
    def bin(self) -> Path:
        return self.folder / ("Scripts" if sys.platform == "win32" else "bin")

    def run(self, *arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
        program, *rest = map(str, arguments)
        return ran(self.bin / program, *rest, cwd=cwd)

    def install(self, *what: object) -> None:
        """As a user does; or faster, and only what is imported is compiled, when it is."""
        if self.has_pip:
            done = self.run("python", "-m", "pip", "install", "-q", *what, cwd=self.folder)
        else:
            place = ("--python", self.bin / "python", "install", "--no-compile", "-q")
            done = ran(*PIP, *place, *what, cwd=self.folder)
        assert done.returncode == 0, done.stderr


def ran(*command: object, cwd: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        list(map(str, command)),
        cwd=cwd,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="session")
def archives(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The source archive, and the wheel made of it.

    With the backend that is here; pip fetches its own one where it builds, below.
    """
    folder = tmp_path_factory.mktemp("dist")
    built = ran(
        *(sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, ROOT), cwd=folder
    )
    assert built.returncode == 0, built.stdout + built.stderr
    return next(folder.glob("*.tar.gz")), next(folder.glob("*.whl"))


def test_another_build_is_the_same(archives: tuple[Path, Path], tmp_path: Path) -> None:
    """Also of files that were fetched at another time, by somebody with other rights."""
    copy = tmp_path / "clone"
    git = ("git", "-c", "core.sharedRepository=umask", "clone", "-q", ROOT, copy)
    assert ran(*git, cwd=tmp_path).returncode == 0
    changed = ran("git", "diff", "HEAD", "--binary", cwd=ROOT).stdout
    if changed:
        (tmp_path / "changed").write_text(changed)
        assert ran("git", "apply", tmp_path / "changed", cwd=copy).returncode == 0
    command = (sys.executable, "-m", "build", "--no-isolation", "--outdir", tmp_path / "dist", copy)
    assert ran(*command, cwd=tmp_path).returncode == 0
    for one in archives:
        assert (tmp_path / "dist" / one.name).read_bytes() == one.read_bytes()


def made(folder: Path, *options: str) -> Environment:
    subprocess.run([sys.executable, "-m", "venv", *options, str(folder)], check=True)
    return Environment(folder, has_pip=not options)


@pytest.fixture
def environment(tmp_path: Path) -> Environment:
    """A fresh one without pip, which would take as long as some extras."""
    return made(tmp_path / "venv", "--without-pip")


@pytest.fixture(scope="session")
def core(archives: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Environment:
    """One as `python -m venv` makes it, with the core, installed as a user does; never changed."""
    environment = made(tmp_path_factory.mktemp("core") / "venv")
    environment.install(archives[1])
    return environment


def on_top_of(core: Environment, folder: Path, *options: str) -> Environment:
    """A fresh one to which all that is installed in the core's seems to be installed."""
    environment = made(folder, *options)
    ask = ("python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))")
    places = [Path(one.run(*ask, cwd=folder).stdout.strip()) for one in (environment, core)]
    (places[0] / "core.pth").write_text(f"{places[1]}\n")
    return environment


@pytest.fixture(scope="session")
def newest_pip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a pip that asks an index what it could install, and downloads none of it."""
    folder = tmp_path_factory.mktemp("pip")
    done = ran(*PIP, "install", "-q", "--no-compile", "--target", folder, "pip>=26", cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder with programs and nothing of the repository."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    for name in ("circle.mod", "pentagon.mod", "pentagon.answers.txt"):
        shutil.copy(ROOT / "programs" / name, folder)
    shutil.copytree(ROOT / "robots" / "irb120-3-0.58", folder / "arm")
    return folder


def size_mb(folder: Path, *, but: str | None = None) -> float:
    """Size of the files [MB], without pip and those with a suffix."""
    files = (one for one in folder.rglob("*") if one.is_file() and not one.is_symlink())
    counted = (one for one in files if "pip" not in one.parts and one.suffix != but)
    return sum(one.stat().st_size for one in counted) / 1e6


def test_the_wheel_is_small(archives: tuple[Path, Path]) -> None:
    assert archives[1].stat().st_size / 1e6 < WHEEL_MB


def extra(wheel: Path, name: str) -> str:
    return f"rapidsim[{name}] @ {wheel.as_uri()}"


IK = ("kin", "ik", "--robot", "irb120", "--position", "374,0,630")
QUATERNION = ("--quaternion", "0.7071068,0,0.7071068,0")
NEEDS = {
    "view": ("run", "circle.mod", "--record", "x.rrd"),
    "urdf": ("kin", "fk", "--robot", "arm/irb120-3-0.58.urdf", "--joints", "0,0,0,0,0,0"),
    "solvers": (*IK, *QUATERNION, "--solver", "lm"),
    "parquet": ("run", "circle.mod", "--no-record", "--trace", "x.parquet"),
    "plots": ("run", "circle.mod", "--no-record", "--plots", "pictures"),
}
"""By extra, a command that needs it."""


def test_the_core_is_small_and_does_all_but_what_it_says(
    core: Environment, elsewhere: Path
) -> None:
    assert size_mb(core.folder) < CORE_MB
    assert size_mb(core.folder, but=".pyc") < SOURCES_MB
    for arguments in (
        ("check", "circle.mod", "--robot", "irb1600"),
        ("run", "circle.mod", "--report", "x.html", "--trace", "x.csv", "--events", "x.jsonl"),
        ("frames", "circle.mod"),
        (*IK, *QUATERNION),
        ("explain", "K603"),
        ("robots", "irb1600"),
    ):
        ended = core.run("rapidsim", *arguments, cwd=elsewhere)
        assert ended.returncode == 0, ended.stderr
    assert (elsewhere / "x.html").is_file()
    assert (elsewhere / "x.csv").is_file()
    assert not (elsewhere / "lines.rrd").exists()
    for name, needing in NEEDS.items():
        ended = core.run("rapidsim", *needing, cwd=elsewhere)
        assert ended.returncode == 2
        assert f'pip install "rapidsim[{name}]"' in ended.stderr


@pytest.mark.parametrize("name", sorted(set(EXTRAS.values())))
def test_an_extra_brings_what_it_is_for(
    name: str, archives: tuple[Path, Path], core: Environment, elsewhere: Path, tmp_path: Path
) -> None:
    environment = on_top_of(core, tmp_path / "venv", "--without-pip")
    environment.install(extra(archives[1], name))
    package = next(package for package, of in EXTRAS.items() if of == name)
    ended = environment.run("python", "-c", f"import {package}", cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr
    if name in NEEDS:
        ended = environment.run("python", "-m", "rapidsim", *NEEDS[name], cwd=elsewhere)
        assert ended.returncode == 0, ended.stderr


def test_the_command_that_a_message_names_brings_an_extra(
    core: Environment, elsewhere: Path, tmp_path: Path
) -> None:
    environment = on_top_of(core, tmp_path / "venv")
    environment.install("rapidsim[parquet]")
    ended = environment.run("python", "-m", "rapidsim", *NEEDS["parquet"], cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr


def test_the_first_command_of_the_readme_ends_in_a_recording(
    archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    first = re.search(
        r"^.*pip install -q -e '(\.\[\w+\])' && \S*/rapidsim (run .*)$",
        (ROOT / "README.md").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    assert first is not None
    environment.install(extra(archives[1], first[1][2:-1]))
    arguments = first[2].replace("programs/", "").split()
    ended = environment.run("rapidsim", *arguments, cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr
    assert (elsewhere / "pentagon.rrd").stat().st_size > 10_000
    assert size_mb(environment.folder) < ALL_MB


def test_the_source_archive_installs(
    archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    environment.install(archives[0])
    ended = environment.run("rapidsim", "check", "circle.mod", cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr


@pytest.mark.parametrize("what", ["editable", "wheel"])
def test_mypy_follows_what_is_installed(
    what: str, core: Environment, elsewhere: Path, tmp_path: Path
) -> None:
    if what == "wheel":
        environment = on_top_of(core, tmp_path / "venv", "--without-pip")
        environment.install("types-greenlet")
    else:
        environment = made(tmp_path / "venv", "--without-pip")
        environment.install("types-greenlet", "-e", ROOT)
    looking_there = ("--python-executable", environment.bin / "python", "--strict")
    (elsewhere / "user.py").write_text(USER_PROGRAM)
    ended = ran(*MYPY, *looking_there, "user.py", cwd=elsewhere)
    assert ended.returncode == 0, ended.stdout
    (elsewhere / "wrong.py").write_text(USER_PROGRAM.replace("moves: int", "moves: str"))
    ended = ran(*MYPY, *looking_there, "wrong.py", cwd=elsewhere)
    assert ended.returncode == 1
    assert "Incompatible types" in ended.stdout


def test_types_hold_with_the_newest_python() -> None:
    """The oldest one is checked with the other tools; each version takes a minute."""
    ended = ran(*MYPY, "--python-version", PYTHONS[-1], cwd=ROOT)
    assert ended.returncode == 0, ended.stdout


@pytest.mark.parametrize("python", PYTHONS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_wheels_of_all_dependencies_exist(
    python: str, system: str, archives: tuple[Path, Path], newest_pip: Path, tmp_path: Path
) -> None:
    report = tmp_path / "report.json"
    done = ran(
        *(*PIP, "install", "-q", "--dry-run", "--ignore-installed", "--only-binary=:all:"),
        "--implementation=cp",
        f"--python-version={python}",
        *(f"--platform={one}" for one in SYSTEMS[system]),
        f"--target={tmp_path / 'unused'}",
        f"--report={report}",
        extra(archives[1], "all,step"),
        cwd=tmp_path,
        PYTHONPATH=str(newest_pip),
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(report.read_text(encoding="utf-8"))["install"]
    names = {re.split(r"\W", one["metadata"]["name"])[0].lower() for one in found}
    assert {package.partition("-")[0] for package in EXTRAS} <= names
