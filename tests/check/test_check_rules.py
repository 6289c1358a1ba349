"""Each rule: what its folder says agrees with its class, and its programs show what they promise.

The programs of `bad.mod` break the rule, on the lines marked `! found` and on no others; those of
`good.mod` come near and do not. All that is said of a program stands in a file of `findings/`.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import string
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from inspect import getsource
from pathlib import Path
from typing import Any

import pytest
from check_helper import HERE, found_in
from whole_findings import assert_section, records, whole

import rapidsim
from rapidsim.analysis.rules.table import DETECTORS
from rapidsim.cli.boundary import run_commands
from rapidsim.diagnostics import Rule, Violation, all_rules
from rapidsim.report.pages.rules import programs

ARM = "irb1600-6-1.2"
KEYS = {"severity", "message", "help", "cf", "found-by", "station"}
# Theirs need several tasks, an operator, or an arm in between: tests of those show them.
WITHOUT_PROGRAMS = {"I804", "K615", "M523", "N208", "N216", "N220", "N221", "R103", "R105"}
# About the cell, ends of lines and single characters; a run meets M501 later than a check.
UNMARKED = {"C103", "E106", "E107", "M501", "S903", "S904", "S905"}


PACKAGE = Path(rapidsim.__file__).parent


def classes() -> list[type[Violation]]:
    """Every class of violations of the package; what has none is not imported for it."""
    for file in PACKAGE.rglob("*.py"):
        if 'code="' in file.read_text(encoding="utf-8"):
            import_module(".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts))
    own = (one for one in Violation.__subclasses__() if one.__module__.startswith("rapidsim."))
    return sorted(own, key=lambda one: one.rule.code)


@dataclass(frozen=True)
class Case:
    """A program of a rule's folder, and how it is looked at."""

    rule: Rule
    file: str
    number: int
    program: bytes
    way: str

    def findings(self, folder: Path) -> list[Mapping[str, Any]]:
        """What is found in the program, and said as before."""
        found = self._found(folder)
        text = whole(found).replace(f"{folder}{os.sep}", "")
        assert_section(HERE / "findings" / f"{self.rule.code[0]}.txt", name(self), text)
        return found

    def _found(self, folder: Path) -> list[Mapping[str, Any]]:
        file = folder / "program.mod"
        file.write_bytes(self.program)
        station = table(self.rule).get("station", "")
        if station:
            (folder / "rapidsim.toml").write_text(station)
        arm = ("--robot", tomllib.loads(station).get("robot", {}).get("model", ARM))
        match self.way:
            case "text":
                return records(found_in(file, every_rule=True))
            case "reach":
                return as_printed("check", str(file), *arm, "--no-merge", "--output-format")
            case _:
                return as_printed("run", str(file), *arm, "--no-record", "--format")


def table(rule: Rule) -> dict[str, str]:
    return tomllib.loads(rule.read("rule.toml").decode("utf-8"))


def found_by(rule: Rule) -> list[str]:
    """What finds the rule: the `text`, asking an arm whether it can (`reach`), a `run`."""
    return table(rule).get("found-by", "text").split(", ")


def as_printed(*arguments: str) -> list[Mapping[str, Any]]:
    """What a command says of a program; the last argument asks for a format."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        run_commands([*arguments, "json"])
    found: list[Mapping[str, Any]] = json.loads(printed.getvalue())["diagnostics"]
    return found


def cases(file: str) -> list[Case]:
    """All programs of `bad.mod` or `good.mod`; that of the page is looked at in every way."""
    return [
        Case(rule, file.removesuffix(".mod"), number, program, way)
        for rule in all_rules()
        for number, program in enumerate(programs(rule, file))
        for way in found_by(rule)
        if program and (number == 0 or way == found_by(rule)[0])
    ]


def name(case: Case) -> str:
    return f"{case.rule.code}-{case.file}-{case.number}-{case.way}"


@pytest.mark.parametrize("case", cases("bad.mod"), ids=name)
def test_a_bad_program_breaks_the_rule_where_it_says(case: Case, tmp_path: Path) -> None:
    findings = case.findings(tmp_path)
    found = [one for one in findings if one["code"] == case.rule.code]
    assert found, findings
    assert {one["severity"] for one in found} == {case.rule.severity}
    lines = case.program.decode("utf-8").splitlines()
    marked = [number for number, line in enumerate(lines, start=1) if "! found" in line]
    assert sorted({one["line"] or 0 for one in found}) == marked or case.rule.code in UNMARKED
    others = [one for one in findings if one["code"] != case.rule.code]
    if case.rule.code[0] == "E":
        # What is left of a broken statement may be wrong in other ways, but not as a text.
        assert not [one for one in others if one["code"][0] == "E"]
    elif case.way == "text":
        assert not [one for one in others if one["severity"] == "error"]
    for one in findings:
        assert "\n" not in one["message"]
        assert not one["message"].endswith(".")


@pytest.mark.parametrize("case", cases("good.mod"), ids=name)
def test_a_good_program_keeps_the_rule(case: Case, tmp_path: Path) -> None:
    findings = case.findings(tmp_path)
    assert not [
        one for one in findings if one["code"] == case.rule.code or one["severity"] == "error"
    ]
    assert case.rule.code[0] != "E" or not [one for one in findings if one["code"][0] == "E"]
    if case.number == 0 and case.way != "text":
        # A cure that causes something else is none.
        assert not [one for one in findings if found_by(Rule(one["code"])) != ["text"]]


def test_each_rule_has_a_folder_and_a_class() -> None:
    assert [one.rule for one in classes()] == list(all_rules())


def test_every_rule_declared_beside_a_detector_is_looked_for() -> None:
    beside = {one for one in classes() if one.__module__.startswith("rapidsim.analysis.rules.")}
    assert beside <= {broken for detector in DETECTORS for broken in detector.rules}


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.code)
def test_a_folder_says_all_there_is_to_say(rule: Rule) -> None:
    assert table(rule).keys() <= KEYS
    assert rule.read("page.md").endswith(b".\n")
    for file in ("bad.mod", "good.mod"):
        assert any(programs(rule, file)) == (rule.code not in WITHOUT_PROGRAMS)


@pytest.mark.parametrize("violation", classes(), ids=lambda violation: violation.rule.code)
def test_message_and_fields_agree(violation: type[Violation]) -> None:
    said = violation.rule.message + violation.rule.help
    named = {field for _, field, _, _ in string.Formatter().parse(said) if field}
    own = set(violation.facts)
    asked = set(re.findall(r"self\.(\w+)", getsource(violation)))
    assert named <= own
    assert own <= named | asked
