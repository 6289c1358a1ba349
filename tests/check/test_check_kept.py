"""Results that are kept: as fresh ones in every format, and never those of something else."""

import json
import os
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import pytest
from check_helper import CORPUS, HERE
from command_line import Ended, call

from rapidsim.cli.tools.check_output import FORMATS
from rapidsim.diagnostics import Violation
from rapidsim.files import InputError
from rapidsim.jobs.cache import fingerprints
from rapidsim.jobs.cache.finding_records import (
    NoRecordError,
    StoredFindings,
    read_findings,
    record_of,
)
from rapidsim.jobs.cache.fingerprints import NoFingerprintError, fingerprint, of_installation
from rapidsim.jobs.cache.result_cache import ResultCache, sources_of
from rapidsim.jobs.cache.result_store import ResultStore, cache_folder
from rapidsim.jobs.checking import batch_check
from rapidsim.jobs.checking.batch_check import check_jobs
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_request import RunRequest

PROGRAMS = Path(__file__).parents[2] / "programs"
CASES: list[tuple[str, ...]] = [
    (str(PROGRAMS / "cell"),),
    (str(PROGRAMS / "shared_machine"),),
    (str(PROGRAMS / "out_of_reach.mod"), "--robot", "irb1600"),
    (str(CORPUS / "backup"),),
    (str(CORPUS / "handling"),),
    (str(HERE / "planted" / "welding_cell.mod"), "--extend-select", "S,F4,T3,M5"),
    ("--each", *(str(PROGRAMS / name) for name in ("cell", "pentagon.mod"))),
    ("--each", str(CORPUS / "unicode.mod"), str(CORPUS / "several.mod"), "--extend-select", "S"),
]
"""The last is tried in every format."""
ARM = '[robot]\nmodel = "irb120"\n'
STATION = f"""{ARM}
[controller]
stubs = ["stubs/stub.mod"]
[signals]
doReady = {{ type = "do" }}
"""
MODULE = """MODULE job
  PERS tooldata tPen:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PROC main()
    SetDO doReady,1;
    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tPen;
    pause;
    library;
  ENDPROC
ENDMODULE
"""
OTHER = "MODULE other\n  PROC pause()\n    WaitTime 0.1;\n  ENDPROC\nENDMODULE\n"
STUB = "MODULE stub\n  PROC library()\n  ENDPROC\nENDMODULE\n"


def timeless(ended: Ended) -> tuple[int, str, str]:
    return ended.code, re.sub(r" \([0-9.]+ s\)", "", ended.out), ended.err


def check(kept: Path, cwd: Path, *arguments: str) -> tuple[int, str, str]:
    variables = {"RAPIDSIM_NO_CACHE": "", "RAPIDSIM_CACHE_DIR": str(kept)}
    return timeless(call("check", *arguments, cwd=cwd, environment=variables))


def entries(kept: Path) -> set[str]:
    return {one.name for one in kept.iterdir()} if kept.exists() else set()


def refused(*_: object) -> None:
    raise AssertionError("it was checked anew")


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of rapidsim is not read for each of the folders that tests keep results in."""
    monkeypatch.setattr(
        "rapidsim.jobs.cache.result_cache.of_installation", lambda _: "installation"
    )


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("arguments", CASES, ids=lambda one: Path(one[0]).name)
def test_what_is_kept_is_told_as_what_is_found(arguments: tuple[str, ...], tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    for form in FORMATS if arguments is CASES[-1] else ("full", "json"):
        asked = (*arguments, "--output-format", form)
        fresh = timeless(call("check", *asked, cwd=tmp_path))
        if not kept.exists():
            assert check(kept, tmp_path, *asked) == fresh
            assert entries(kept)
        with patch("rapidsim.jobs.checking.check_files.check_job", refused):
            assert check(kept, tmp_path, *asked) == fresh
        assert fresh[0] in (0, 1)


@pytest.fixture
def cell(tmp_path: Path) -> Path:
    folder = tmp_path / "cell"
    (folder / "stubs").mkdir(parents=True)
    (folder / "rapidsim.toml").write_text(STATION)
    (folder / "job.mod").write_text(MODULE)
    (folder / "other.mod").write_text(OTHER)
    (folder / "stubs" / "stub.mod").write_text(STUB)
    return folder


def in_file(name: str, old: str, new: str) -> Callable[[Path], tuple[str, ...]]:
    def change(folder: Path) -> tuple[str, ...]:
        text = (folder / name).read_text()
        assert old in text
        (folder / name).write_text(text.replace(old, new))
        return ()

    return change


def in_new_file(name: str, text: str) -> Callable[[Path], tuple[str, ...]]:
    def change(folder: Path) -> tuple[str, ...]:
        (folder / name).write_text(text)
        return ()

    return change


def gone(name: str) -> Callable[[Path], tuple[str, ...]]:
    def change(folder: Path) -> tuple[str, ...]:
        (folder / name).unlink()
        return ()

    return change


def with_options(*options: str) -> Callable[[Path], tuple[str, ...]]:
    return lambda _: options


CHANGES = {
    "a module": in_file("job.mod", "MoveAbsJ [[10", "MoveAbsJ [[400"),
    "a module, by its length alone": in_file("job.mod", "    pause;\n", "    pause;\n\n  wrong;\n"),
    "another module": in_file("other.mod", "WaitTime 0.1", "WaitTime 1/0"),
    "a module more": in_new_file("more.mod", OTHER.replace("MODULE other", "MODULE more")),
    "a module less": gone("other.mod"),
    "a stub": in_file("stubs/stub.mod", "library()", "library(num n)"),
    "the arm": in_file("rapidsim.toml", '"irb120"', '"kr10"'),
    "where the arm begins": in_file("rapidsim.toml", ARM, ARM + "start = [0,0,0,0,90,0]\n"),
    "signals": in_file("rapidsim.toml", "doReady", "doRaedy"),
    "settings in the station file": in_file(
        "rapidsim.toml", ARM, '[check]\nextend-select = ["S9"]\n' + ARM
    ),
    "settings of the project": in_new_file(
        "pyproject.toml", '[tool.rapidsim.check]\nextend-select = ["S9"]\n'
    ),
    "the arm asked for": with_options("--robot", "irb1600"),
    "rules": with_options("--select", "S9"),
    "more rules": with_options("--extend-select", "S9"),
    "no reach": with_options("--no-reach"),
    "no run": with_options("--no-run"),
    "what is checked": with_options("job.mod"),
}
UNSEEN = {"the arm", "where the arm begins", "no run", "what is checked", "the arm asked for"}
"""Changes that need not change what is printed; that a result is made anew is looked at."""


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("change", CHANGES)
def test_whatever_changes_is_seen(change: str, cell: Path, tmp_path: Path) -> None:
    kept, plain = tmp_path / "kept", (".", "--output-format", "json")
    before = check(kept, cell, *plain)
    known = entries(kept)
    arguments = (*plain, *CHANGES[change](cell))
    after = check(kept, cell, *arguments)
    assert after == timeless(call("check", *arguments, cwd=cell))
    assert after != before or change in UNSEEN
    assert entries(kept) > known


@pytest.mark.usefixtures("installed")
def test_what_a_backup_says_of_its_cell_is_seen(tmp_path: Path) -> None:
    """All files are changed before a fresh check, for what is missed of one stays missed."""
    backup, kept = tmp_path / "backup", tmp_path / "kept"
    shutil.copytree(CORPUS / "backup", backup)
    found = check(kept, tmp_path, "backup")
    for file in sorted(file for file in backup.rglob("*") if file.is_file()):
        known = entries(kept)
        text = file.suffix.lower() in (".mod", ".sys", ".modx")
        file.write_bytes((b"! changed\n" if text else b"\n# new\n") + file.read_bytes())
        found = check(kept, tmp_path, "backup")
        assert entries(kept) > known or not text
    assert found == timeless(call("check", "backup", cwd=tmp_path))


@pytest.mark.usefixtures("installed")
def test_a_task_that_did_not_change_is_not_looked_at_again(tmp_path: Path) -> None:
    folder, kept = tmp_path / "two", tmp_path / "kept"
    shutil.copytree(PROGRAMS / "shared_machine", folder)
    check(kept, folder, ".")
    unload = folder / "Unload.mod"
    unload.write_text(unload.read_text() + "! a comment\n")
    looked_at = []
    made = batch_check._ObservedJob.record

    def noted(watched: object, found: object, *more: object) -> object:
        looked_at.append(type(found).__name__)
        return made(watched, found, *more)  # type: ignore[arg-type]

    with patch.object(batch_check._ObservedJob, "record", noted):
        found = check(kept, folder, ".")
    assert found == timeless(call("check", ".", cwd=folder))
    assert looked_at == ["ReachReport", "CheckResult"]


def test_rapidsim_itself_is_one_of_the_inputs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = ResultStore(tmp_path / "kept")
    code = tmp_path / "code"
    (code / "inner").mkdir(parents=True)
    source = code / "inner" / "module.py"
    monkeypatch.setattr(fingerprints, "_folders", lambda: (code,))
    packages = ["numpy-2.3.0.dist-info"]
    monkeypatch.setattr(fingerprints, "_packages", lambda: packages)

    def now() -> str:
        of_installation.cache_clear()
        return of_installation(store)

    found = {}
    source.write_text("one = 1\n")
    found["at first"] = now()
    os.utime(source, (1, 1))
    assert now() == found["at first"], "its content counts, not its date"
    source.write_text("one = 2\n")
    found["of the same length"] = now()
    (code / "robot.toml").write_text("")
    found["a file more"] = now()
    (code / "robot.toml").write_text("a = 1")
    found["longer"] = now()
    packages.append("numba-0.6.dist-info")
    found["a package more"] = now()
    assert len(set(found.values())) == len(found)
    of_installation.cache_clear()


def a_job(*paths: Path, **asked: object) -> Job:
    return job(RunRequest(paths=tuple(map(str, paths)), **asked))  # type: ignore[arg-type]


def kinds_of_facts(violation: Violation) -> dict[str, type]:
    facts = vars(violation).items()
    return {name: float if isinstance(fact, float) else type(fact) for name, fact in facts}


def test_records_hold_all_that_the_rules_find(rule_programs: list[Path]) -> None:
    kinds = set()
    for file in rule_programs:
        if "-bad-0" not in file.name:
            continue
        try:
            # On an arm that is chosen by the targets they are in reach.
            made = a_job(file, robot="irb1600-6-1.2", extend_select=("S", "F4", "M5", "T3"))
        except InputError:
            continue
        result = check_job(made)
        found = StoredFindings(result.diagnostics, result.coverage, ("a notice",), lasts=True)
        sources = sources_of(made)
        read = read_findings(json.loads(json.dumps(record_of(found, sources))), sources)
        assert len(read.diagnostics) == len(found.diagnostics)
        for ours, theirs in zip(read.diagnostics, found.diagnostics, strict=True):
            assert ours.violation == theirs.violation
            assert kinds_of_facts(ours.violation) == kinds_of_facts(theirs.violation)
            assert (repr(ours), ours.help, ours.order) == (repr(theirs), theirs.help, theirs.order)
            assert repr(ours.related) == repr(theirs.related)
            assert repr(ours.fix) == repr(theirs.fix)
            assert (ours.routine, ours.assumed) == (theirs.routine, theirs.assumed)
            kinds.add(ours.code)
        assert repr(read.coverage) == repr(found.coverage)
        assert [one.reason for one in read.coverage.unchecked] == [
            one.reason for one in found.coverage.unchecked
        ]
    assert len(kinds) > 140


FACTS = {"str", "int", "float", "bool", "str | None", "tuple[str, ...]"}


def test_facts_are_what_a_record_can_hold() -> None:
    def below(kind: type[Violation]) -> set[type[Violation]]:
        return {kind}.union(*map(below, kind.__subclasses__()))

    for kind in below(Violation) - {Violation}:
        if not kind.__module__.startswith("rapidsim."):
            continue
        assert kind.__qualname__ == kind.__name__, "it is found by its name in its module"
        for one in kind.__mro__:
            facts = vars(one).get("__annotations__", {})
            told = {of for name, of in facts.items() if name in kind.facts}
            assert told <= {*FACTS, f"tuple[{kind.__name__}, ...]"}, kind


def with_violation(*violation: object) -> list[object]:
    finding: dict[str, object] = {
        "violation": violation,
        "span": None,
        "related": [],
        "assumed": False,
    }
    return [[], {"diagnostics": [finding], "coverage": {}, "notices": [], "lasts": True}]


def test_a_violation_of_ours_is_read() -> None:
    kind = "rapidsim.analysis.suppressions", "UnusedSuppression"
    assert read_findings(with_violation(*kind, [["K601"]]), ()).lasts


@pytest.mark.parametrize(
    "record",
    [
        [],
        "text",
        [[], {"diagnostics": [], "coverage": {}, "notices": []}],
        with_violation("os", "system", ["true"]),
        with_violation("rapidsim.files", "InputError", ["a"]),
        [[["elsewhere.mod", None]], with_violation()[1]],
    ],
)
def test_what_is_no_record_is_refused(record: object) -> None:
    with pytest.raises(NoRecordError):
        read_findings(record, ())


def test_what_cannot_be_read_is_made_anew(cell: Path, tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    found = check(kept, cell, ".")
    for spoilt in ("", "[", "{}", "[[], [1]]", "\x00"):
        for file in kept.iterdir():
            file.write_text(spoilt)
        of_installation.cache_clear()
        assert check(kept, cell, ".") == found
    of_installation.cache_clear()


@pytest.mark.usefixtures("installed")
def test_a_folder_that_cannot_be_written_keeps_nothing(cell: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    found = timeless(call("check", ".", cwd=cell))
    for kept in (tmp_path / "file", tmp_path / "file" / "below"):
        assert check(kept, cell, ".") == found
    assert (tmp_path / "file").read_text() == ""


def test_one_switch_leaves_it_out(cell: Path, tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    check(kept, cell, ".", "--no-cache")
    check(kept, cell, ".", "--diff")
    assert not kept.exists()


def test_what_was_ended_by_the_clock_is_not_kept(
    cell: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ends = iter(range(1000))
    monkeypatch.setattr(batch_check, "_runs_ended", lambda: next(ends))
    store = ResultStore(tmp_path / "kept")
    [*_] = check_jobs([a_job(cell)], ResultCache(store))
    assert len(entries(store.folder)) == 1, "only what is known of the installation"


def test_arms_from_files_of_the_user_are_checked_anew(cell: Path, tmp_path: Path) -> None:
    store = ResultStore(tmp_path / "kept")
    made, kept = a_job(cell), ResultCache(store)
    [robot] = made.station.robots
    record = record_of(StoredFindings((), check_job(made).coverage, (), lasts=True), ())
    named = replace(made, robot=replace(made.robot, name="arms/My.URDF"))
    shaped = replace(robot, shapes=Path("shapes"))
    dressed = replace(made, station=replace(made.station, robots=(shaped,)))
    for one in (named, dressed):
        kept.keep_job(one, record)
        assert kept.of_job(one) is None
    kept.keep_job(made, record)
    assert kept.of_job(made) is not None


def test_values_have_fingerprints_of_their_own() -> None:
    values: tuple[object, ...] = (
        *(0, 0.0, -0.0, False, None, "", b"", (), [], {}, frozenset[int](), "0", "None"),
        *(("a", "b"), ("ab",), (("a",), "b"), ("a", ("b",)), {"a": "b"}, {"a", "b"}),
        *(Path("a"), float("nan"), 1e-300, 1, 1.0),
    )
    assert len({fingerprint(one) for one in values}) == len(values)
    assert fingerprint("a", "b") != fingerprint("ab")
    with pytest.raises(NoFingerprintError):
        fingerprint([test_values_have_fingerprints_of_their_own])


def test_there_is_never_much_of_it(tmp_path: Path) -> None:
    store = ResultStore(tmp_path)
    for number in range(10):
        store.keep(f"{number}", "x" * 100)
        os.utime(tmp_path / f"{number}.json", (number, number))
    (tmp_path / "readme").write_text("of the user")
    assert store.value("0") == "x" * 100  # and is used last
    store.tidy(10_000)
    assert len(entries(tmp_path)) == 11
    store.tidy(600)
    assert entries(tmp_path) == {"0.json", *(f"{n}.json" for n in (7, 8, 9)), "readme"}


def test_the_folder_is_where_the_system_has_such_things() -> None:
    named = {"RAPIDSIM_CACHE_DIR": "here"}
    assert all(cache_folder(named, one) == Path("here") for one in ("linux", "win32", "darwin"))
    assert cache_folder({"XDG_CACHE_HOME": "/c"}, "linux") == Path("/c/rapidsim")
    assert cache_folder({}, "linux") == Path.home() / ".cache" / "rapidsim"
    assert cache_folder({"LOCALAPPDATA": "L"}, "win32") == Path("L/rapidsim/Cache")
    assert cache_folder({}, "darwin") == Path.home() / "Library" / "Caches" / "rapidsim"
