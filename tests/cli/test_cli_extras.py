"""Where a package is missing, whoever needs it reads which command brings it."""

import tomllib
from pathlib import Path

import pytest
from command_line import call

import rapidsim
from rapidsim import extras
from rapidsim.extras import EXTRAS
from rapidsim.files import InputError

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "programs" / "circle.mod"
URDF = ROOT / "robots" / "irb120-3-0.58" / "irb120-3-0.58.urdf"
POSE = ("--position", "374,0,630", "--quaternion", "0.7071068,0,0.7071068,0")

ASKED = (
    ("rerun", ("run", PROGRAM, "--record", "x.rrd")),
    ("rerun", ("run", PROGRAM, "--view")),
    ("rerun", ("view", "x.rrd")),
    ("rerun", ("follow", ROOT / "programs" / "rvm1_line.csv", "--record", "x.rrd")),
    ("pyarrow", ("run", PROGRAM, "--trace", "x.parquet")),
    ("pyarrow", ("follow", ROOT / "programs" / "rvm1_line.csv", "--trace", "x.parquet")),
    ("matplotlib", ("run", PROGRAM, "--plots", "pictures")),
    ("scipy", ("kin", "ik", "--robot", "irb120", *POSE, "--solver", "lm")),
    ("scipy", ("follow", ROOT / "programs" / "kr10_row.csv", "--robot", "kr10", "--starts")),
    ("rerun", ("kin", "fk", "--robot", "irb120", "--joints", "0,0,0,0,0,0", "--record", "a.rrd")),
    ("yourdfpy", ("kin", "fk", "--robot", URDF, "--joints", "0,0,0,0,0,0")),
    ("yourdfpy", ("run", PROGRAM, "--no-record", "--robot", URDF)),
    ("yourdfpy", ("check", PROGRAM, "--robot", URDF)),
    ("pygls", ("lsp",)),
)


@pytest.fixture
def core(monkeypatch: pytest.MonkeyPatch) -> None:
    """As after `pip install rapidsim`, as far as one asks whether a package is there."""
    monkeypatch.setattr(extras, "find_spec", lambda name: None if name in EXTRAS else object())


@pytest.mark.usefixtures("core")
@pytest.mark.parametrize(("package", "arguments"), ASKED, ids=lambda value: str(value)[:30])
def test_what_is_asked_for_is_refused_at_once(
    package: str, arguments: tuple[object, ...], tmp_path: Path
) -> None:
    ended = call(*arguments, cwd=tmp_path)
    assert ended.code == 2
    assert f"needs {package}, which is not installed" in ended.err
    assert f' help: pip install "rapidsim[{EXTRAS[package]}]"' in ended.err
    assert not list(tmp_path.iterdir())


@pytest.mark.usefixtures("core")
def test_a_recording_by_default_is_a_note(tmp_path: Path) -> None:
    ended = call("run", PROGRAM, cwd=tmp_path)
    assert ended.code == 0
    note = 'note: no recording, which needs rerun: pip install "rapidsim[view]"'
    assert ended.err.splitlines() == [note]
    assert ".rrd" not in ended.out
    assert call("run", PROGRAM, "-q", cwd=tmp_path).err == ""
    assert call("run", PROGRAM, "--no-record", cwd=tmp_path).err == ""


@pytest.mark.usefixtures("core")
def test_python_reads_it_too() -> None:
    with pytest.raises(InputError, match="record needs rerun") as raised:
        rapidsim.record  # noqa: B018 - The access is the test.
    assert raised.value.help == 'pip install "rapidsim[view]"'


def test_messages_name_the_extras_there_are() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    offered = project["optional-dependencies"]
    assert set(offered) - {"all", "dev", "docs"} == set(EXTRAS.values())
    # OpenCASCADE is the heaviest for what it does.
    assert offered["all"] == [f"rapidsim[{','.join(sorted(set(EXTRAS.values()) - {'step'}))}]"]
    for package, extra in EXTRAS.items():
        assert any(one.startswith(package) for one in offered[extra])
