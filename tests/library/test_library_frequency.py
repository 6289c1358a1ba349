"""What public programs call most often is simulated; `pytest -s` prints the table."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from rapidsim.library.catalogue import ROUTINES

WILD = Path(__file__).parents[2].parent / "shared" / "reference" / "rapid_in_the_wild.md"

SITE_ARTEFACTS = {"LOGGING", "ROBOTIQ2F85GRIPPER"}
"""Names of one site each, which RAPID does not have."""
PROCESS_PACKAGES = ("ARC", "EGM")
"""Beginnings of the names of options that stand in: a weld moves, a sensor guides nothing."""

LISTS = {
    "instructions by calls": r"^\*\*Instructions\*\* (.*)",
    "functions by calls": r"^\*\*Functions\*\* (.*)",
    "by repositories, each weighted 1": r"^\*\*Core 40[^*]*\*\* (.*)",
    "by repositories that use it": r"^\*\*By breadth[^*]*\*\* (.*)",
}


def _names(title: str) -> list[str]:
    if not WILD.exists():
        pytest.skip(f"{WILD} is not here")
    match = re.search(LISTS[title], WILD.read_text(encoding="utf-8"), re.MULTILINE)
    assert match is not None
    return re.findall(r"\b[A-Z][A-Z0-9]{2,}\b", match[1])


def _state(name: str) -> str:
    row = ROUTINES.get(name.lower())
    if row is not None:
        return "simulated" if row.simulated else f"stand-in: {row.treated_as}"
    return "no routine of RAPID" if name in SITE_ARTEFACTS else "missing"


def _table(title: str) -> Iterator[str]:
    states = {name: _state(name) for name in _names(title)}
    counts = [list(states.values()).count(state) for state in ("simulated", "missing")]
    yield f"{title}: {len(states)} names, {counts[0]} simulated, {counts[1]} missing"
    yield from (f"  {name}: {state}" for name, state in states.items() if state != "simulated")


@pytest.mark.parametrize("title", LISTS)
def test_the_most_frequent_are_simulated(title: str) -> None:
    print("\n" + "\n".join(_table(title)))  # noqa: T201, the table is for whoever asks with -s
    others = [
        name
        for name in _names(title)
        if _state(name) != "simulated"
        and name not in SITE_ARTEFACTS
        and not (name.startswith(PROCESS_PACKAGES) and _state(name).startswith("stand-in"))
    ]
    assert others == []
