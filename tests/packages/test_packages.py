"""What people install: wheel and source archive in fresh environments, from another folder.

Each environment takes a quarter of a minute and more, so these tests run behind the others.
"""

import json
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from rapidsim.extras import EXTRAS

pytestmark = pytest.mark.packages

ROOT = Path(__file__).parents[2]
MOST_MB = 160
"""What an environment with the core takes, pip included."""
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


@dataclass(frozen=True)
class Environment:
    folder: Path

    @property
    def bin(self) -> Path:
        return self.folder / ("Scripts" if sys.platform == "win32" else "bin")

    def run(self, *arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
        program, *rest = map(str, arguments)
        return subprocess.run(
            [str(self.bin / program), *rest], cwd=cwd, capture_output=True, text=True, check=False
        )

    def install(self, *what: object) -> None:
        done = self.run("python", "-m", "pip", "install", "-q", *what, cwd=self.folder)
        assert done.returncode == 0, done.stderr


@pytest.fixture(scope="session")
def archives(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The source archive, and the wheel made of it."""
    folder = tmp_path_factory.mktemp("dist")
    subprocess.run(
        [sys.executable, "-m", "build", "--outdir", str(folder), str(ROOT)],
        check=True,
        capture_output=True,
    )
    return next(folder.glob("*.tar.gz")), next(folder.glob("*.whl"))


@pytest.fixture
def environment(tmp_path: Path) -> Environment:
    subprocess.run([sys.executable, "-m", "venv", str(tmp_path / "venv")], check=True)
    return Environment(tmp_path / "venv")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder with programs and nothing of the repository."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    for name in ("circle.mod", "pentagon.mod", "pentagon.answers.txt"):
        shutil.copy(ROOT / "programs" / name, folder)
    shutil.copytree(ROOT / "robots" / "irb120-3-0.58", folder / "arm")
    return folder


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
    archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    _, wheel = archives
    environment.install(wheel)
    taken = sum(f.stat().st_size for f in environment.folder.rglob("*") if f.is_file())
    assert taken / 1e6 < MOST_MB
    for arguments in (
        ("check", "circle.mod", "--robot", "irb1600"),
        ("run", "circle.mod", "--report", "x.html", "--trace", "x.csv", "--events", "x.jsonl"),
        ("frames", "circle.mod"),
        (*IK, *QUATERNION),
        ("explain", "K603"),
        ("robots", "irb1600"),
    ):
        ended = environment.run("rapidsim", *arguments, cwd=elsewhere)
        assert ended.returncode == 0, ended.stderr
    assert (elsewhere / "x.html").is_file()
    assert (elsewhere / "x.csv").is_file()
    assert not (elsewhere / "lines.rrd").exists()
    for name, needing in NEEDS.items():
        ended = environment.run("rapidsim", *needing, cwd=elsewhere)
        assert ended.returncode == 2
        assert f'pip install "rapidsim[{name}]"' in ended.stderr


@pytest.mark.parametrize("name", sorted(set(EXTRAS.values())))
def test_an_extra_brings_what_it_is_for(
    name: str, archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    environment.install(extra(archives[1], name))
    package = next(package for package, of in EXTRAS.items() if of == name)
    ended = environment.run("python", "-c", f"import {package}", cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr
    if name in NEEDS:
        ended = environment.run("rapidsim", *NEEDS[name], cwd=elsewhere)
        assert ended.returncode == 0, ended.stderr


def test_the_command_that_a_message_names_brings_an_extra(
    archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    environment.install(archives[1])
    environment.install("rapidsim[parquet]")
    ended = environment.run("rapidsim", *NEEDS["parquet"], cwd=elsewhere)
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


def test_the_source_archive_installs(
    archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    environment.install(archives[0])
    ended = environment.run("rapidsim", "check", "circle.mod", cwd=elsewhere)
    assert ended.returncode == 0, ended.stderr


@pytest.mark.parametrize("what", ["editable", "wheel"])
def test_mypy_follows_what_is_installed(
    what: str, archives: tuple[Path, Path], environment: Environment, elsewhere: Path
) -> None:
    environment.install(
        "mypy", "types-greenlet", *(["-e", ROOT] if what == "editable" else [archives[1]])
    )
    (elsewhere / "user.py").write_text(USER_PROGRAM)
    ended = environment.run("mypy", "--strict", "user.py", cwd=elsewhere)
    assert ended.returncode == 0, ended.stdout
    (elsewhere / "wrong.py").write_text(USER_PROGRAM.replace("moves: int", "moves: str"))
    ended = environment.run("mypy", "--strict", "wrong.py", cwd=elsewhere)
    assert ended.returncode == 1
    assert "Incompatible types" in ended.stdout


@pytest.mark.parametrize("python", PYTHONS[1:])
def test_types_hold_with_every_python(python: str) -> None:
    ended = subprocess.run(
        [sys.executable, "-m", "mypy", "--python-version", python],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stdout


@pytest.mark.parametrize("python", PYTHONS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_wheels_of_all_dependencies_exist(
    python: str, system: str, archives: tuple[Path, Path], tmp_path: Path
) -> None:
    report = tmp_path / "report.json"
    done = subprocess.run(
        [
            *(sys.executable, "-m", "pip", "install", "-q", "--dry-run", "--ignore-installed"),
            "--only-binary=:all:",
            "--implementation=cp",
            f"--python-version={python}",
            *(f"--platform={one}" for one in SYSTEMS[system]),
            f"--target={tmp_path / 'unused'}",
            f"--report={report}",
            extra(archives[1], "all"),
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(report.read_text(encoding="utf-8"))["install"]
    names = {re.split(r"\W", one["metadata"]["name"])[0].lower() for one in found}
    assert {package.partition("-")[0] for package in EXTRAS} <= names
