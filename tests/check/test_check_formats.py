"""What other tools read is as they want it: SARIF by its schema, JUnit and GitHub by parsing."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import junitparser
import pytest
from check_helper import CORPUS, HERE, found_in
from jsonschema import Draft4Validator

import rapidsim
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.report.findings.github import github
from rapidsim.report.findings.junit import junit
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.sarif import sarif

RULES = Path(rapidsim.__file__).with_name("rules")
SCHEMA = json.loads((HERE / "schemas" / "sarif-2.1.0.json").read_text("utf-8"))
LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "note"}
PROGRAMS = [
    HERE / "planted" / "welding_cell.mod",
    CORPUS / "unicode.mod",
    CORPUS / "needs_neighbours.mod",
    CORPUS / "mixed_ends.mod",
    *(
        file
        for code in ("E106", "E109", "E118", "S903", "M501", "N202")
        for file in RULES.glob(f"{code}-*/bad.mod")
    ),
]


def found(program: Path) -> tuple[Diagnostic, ...]:
    diagnostics = found_in(program, every_rule=True)
    assert diagnostics
    return diagnostics


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_sarif_is_valid_and_says_the_same(program: Path) -> None:
    diagnostics = found(program)
    log: Any = json.loads(json.dumps(sarif(merged(diagnostics), "1.0"), allow_nan=False))
    assert list(Draft4Validator(SCHEMA).iter_errors(log)) == []
    [run] = log["runs"]
    assert len(run["results"]) == len(diagnostics)
    rules = run["tool"]["driver"]["rules"]
    seen = set()
    for result in run["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
        place = result["locations"][0]["physicalLocation"]
        assert Path(re.sub("^file://", "", unquote(place["artifactLocation"]["uri"]))) == program
        region = place["region"]
        seen.add((result["ruleId"], result["level"], region["startLine"], region["startColumn"]))
    assert seen == {
        (one.violation.code, LEVELS[one.severity], one.span.line, one.span.column)
        for one in diagnostics
        if one.span
    }


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_junit_is_read_by_a_parser(program: Path) -> None:
    diagnostics = found(program)
    other = "cell/clean.mod"
    report = junitparser.JUnitXml.fromstring(
        junit(merged(diagnostics), [str(program), other]).encode()
    )
    suites = {suite.name: suite for suite in report}
    failed = [one for one in diagnostics if one.severity is not Severity.NOTE]
    assert set(suites) == {str(program), other}
    assert suites[str(program)].failures == len(failed)
    assert report.failures == len(failed)
    assert report.errors == 0
    assert report.tests == max(1, len(failed)) + 1
    messages = [result.message for case in suites[str(program)] for result in case.result]
    assert sorted(messages) == sorted(one.violation.message for one in failed)
    [passed] = suites[other]
    assert passed.is_passed


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_github_commands_are_read_back(program: Path) -> None:
    diagnostics = found(program)
    lines = github(merged(diagnostics, merge=False)).splitlines()
    assert len(lines) == len(diagnostics)
    for line, one in zip(lines, sorted(diagnostics, key=lambda d: d.order), strict=True):
        # As the runner reads it: `::command key=value,key=value::message`, escapes undone last.
        match = re.fullmatch(r"::(error|warning|notice) ([^:]*)::(.*)", line)
        assert match, line
        properties = dict(pair.split("=", 1) for pair in match[2].split(","))
        unescaped = {key: _unescaped(value) for key, value in properties.items()}
        assert one.span
        assert unescaped["file"] == str(program)
        assert (int(unescaped["line"]), int(unescaped["col"])) == (one.span.line, one.span.column)
    assert {_unescaped(line.rpartition("::")[2]).split("\n")[0] for line in lines if "::" in line}


def _unescaped(text: str) -> str:
    for code, character in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ",")):
        text = text.replace(code, character)
    return text.replace("%25", "%")
