"""The table: signatures are the manual's; what a routine does not do it says."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from library_controller import RecordingController

from rapidsim.language.annotations import ParameterMode
from rapidsim.language.initial_values import initial_value
from rapidsim.language.reference import Box
from rapidsim.language.types import NUM, ArrayOf, Type
from rapidsim.library.catalogue import CHAPTERS, ROUTINES
from rapidsim.library.table import LibraryRoutine, Parameter

REFERENCE = Path(__file__).parents[2].parent / "shared" / "reference" / "rapid_predefined.json"

# The reference has their names alone; programs show how they are called.
WITHOUT_PARAMETERS_THERE = {
    *("BrakeCheck", "CornerPathWarning", "CyclicBrakeCheck"),
    *("PathLengthGet", "PathLengthReset", "PathLengthStart", "PathLengthStop"),
    *("CamGetResult", "GetUASUserName", "Max", "Min", "TriggAbsJ"),
}

# Where the machine-read reference lost something, and what stands in ours.
DIFFERENT = {
    "CapC": "the data differ from site to site",
    "CapL": "the data differ from site to site",
    "ContactL": "DesiredTorque is a number",
    "EGMActJoint": "J7 is like J1 to J6; what a sensor exchanges came later",
    "EGMMoveC": "its first parameter is called as that of EGMMoveL",
    "EGMSetupAI": "LATR as in EGMSetupUC; all signals by reference",
    "EGMSetupGI": "giE1 is a signal; all of them by reference",
    "EGMRunJoint": "NoWaitCond and what a sensor exchanges came later",
    "EGMRunPose": "NoWaitCond and what a sensor exchanges came later",
    "EGMActPose": "z is like x and y; what a sensor exchanges came later",
    "IndDMove": "it has a speed, as the other three",
    "MatrixSVD": "matrices have two dimensions",
    "MatrixSolve": "a matrix has two dimensions",
    "MatrixSolveQR": "matrices have two dimensions",
    "ReadStr": "Status came with RobotWare 7",
    "STCalib": "the gun by its name; what it measures",
    "STClose": "the gun by its name, the thickness of the sheets",
    "STTune": "what is tuned",
    "TaskIsExecuting": "a task by reference or by name, as in TaskIsActive",
    "TriggJIOs": "a tool is persistent",
    "TriggLIOs": "a tool is persistent, and there is a work object",
    "UIDnumEntry": "Message and MsgArray are alternatives",
    "UINumEntry": "Message and MsgArray are alternatives; its numbers are num",
    "UIListView": "the items of the list",
    "UINumTune": "Message and MsgArray are alternatives",
    "UIMsgWrite": "a message or an array, both required",
    "WaitDI": "no switch U: the beginning of UIActiveSignal",
    "WaitDO": "no switch UIA: the beginning of UIActiveSignal",
    "WZDOSet": "a stationary zone as well as a temporary one",
    "WZLimSup": "a stationary zone as well as a temporary one",
}


def _theirs() -> list[dict[str, Any]]:
    if not REFERENCE.exists():
        pytest.skip(f"{REFERENCE} is not here")
    routines: list[dict[str, Any]] = json.loads(REFERENCE.read_text(encoding="utf-8"))["routines"]
    return routines


def _spelled(parameter: Parameter) -> tuple[object, ...]:
    return (
        parameter.name,
        tuple(of.name for of in parameter.types),
        parameter.mode.name,
        parameter.optional,
    )


def _expected(parameters: list[dict[str, Any]]) -> list[tuple[object, ...]]:
    """One tuple a parameter, required alternatives such as `Name | Dname` merged into one."""
    expected: list[tuple[object, ...]] = []
    modes: list[set[str]] = []
    before = None
    for p in parameters:
        name = p["type"] + (p.get("dims") or "")
        if not p["optional"] and p.get("alt") and p["alt"] == before:
            first, names, _, _ = expected.pop()
            modes[-1].add(p["mode"])
            assert isinstance(names, tuple)
            mixed = "IN" if "IN" in modes[-1] else "INOUT"
            mode = p["mode"] if len(modes[-1]) == 1 else mixed
            expected.append((first, (*names, name), mode, False))
        else:
            modes.append({p["mode"]})
            expected.append((p["name"], (name,), p["mode"], p["optional"]))
        before = p.get("alt")
    return expected


def _groups(parameters: list[tuple[object, str]]) -> list[list[str]]:
    groups: dict[object, list[str]] = {}
    for key, name in parameters:
        if key:
            groups.setdefault(key, []).append(name)
    return sorted(names for names in groups.values() if len(names) > 1)


def test_every_signature_is_the_manuals() -> None:
    different = set()
    for routine in _theirs():
        name = routine["name"]
        row = ROUTINES[name.lower()]
        if name in WITHOUT_PARAMETERS_THERE or row.signature.is_open:
            continue
        signature = row.signature
        same = (
            row.name == name
            and [_spelled(p) for p in signature.parameters] == _expected(routine["params"])
            and _groups([(p.group, p.name) for p in signature.parameters])
            == _groups([(p.get("alt"), p["name"]) for p in routine["params"] if p["optional"]])
            and (signature.result.name if signature.result else None) == routine["returns"]
        )
        if not same:
            different.add(name)
    assert different == set(DIFFERENT)


def test_names_compare_without_case_and_stand_once() -> None:
    assert all(key == row.name.lower() for key, row in ROUTINES.items())
    assert len(set(ROUTINES)) == len(ROUTINES)
    written = [key for chapter in CHAPTERS.values() for key in chapter]
    assert len(written) == len(set(written))


def test_python_names_of_parameters_differ() -> None:
    names = {row.name: [p.python for p in row.signature.parameters] for row in ROUTINES.values()}
    assert not {name: given for name, given in names.items() if len(set(given)) < len(given)}


BUILT_IN = {"ArgName", "CallByVar", "CONTINUE", "Dim", "IsPers", "IsVar", "Present", "Type"}
DECLARED = [
    row
    for row in ROUTINES.values()
    if row.name not in BUILT_IN and not any(row.name.lower() in c for c in CHAPTERS.values())
]


def _sample(parameter: Parameter) -> object:
    of: Type = parameter.types[0]
    if isinstance(of, ArrayOf):
        return []
    value = initial_value(NUM if of.name == "anytype" else of)
    if of.name.startswith("signal"):
        value = type(value)("doGun")  # type: ignore[call-arg]
    return value if parameter.mode is ParameterMode.IN else Box(value)


@pytest.mark.parametrize("row", DECLARED, ids=lambda row: row.name)
def test_a_declared_routine_reports_itself(row: LibraryRoutine) -> None:
    controller = RecordingController()
    required = [_sample(p) for p in row.signature.parameters if not p.optional]
    options = {"value": 1.0} if row.name.endswith("GO") and row.name.startswith("Move") else {}
    result = controller.call(row.name, *required, **options)
    assert (row.name, row.treated_as) in controller.unsimulated
    assert not row.simulated
    expected = row.signature.result
    assert result == (None if expected is None else initial_value(expected))
    assert len(controller.moves) == (row.treated_as or "").startswith("Move")


def test_built_in_routines_are_left_to_the_interpreter() -> None:
    for name in sorted(BUILT_IN):
        assert ROUTINES[name.lower()].simulated
        with pytest.raises(AssertionError, match="interpreter"):
            ROUTINES[name.lower()].body(1.0)


def test_a_recording_controller_is_a_controller() -> None:
    assert RecordingController().whole().error_numbers.errno == 0.0


@pytest.mark.process
def test_the_catalogue_needs_no_heavy_package() -> None:
    code = (
        "import sys, rapidsim.library.catalogue as c; c.ROUTINES['socketsend'].signature;"
        "print([m for m in ('numpy', 'lark', 'rerun', 'scipy', 'yourdfpy') if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
