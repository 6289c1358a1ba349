"""The VS Code extension as it is packed: with npm, in a folder of its own, nothing global."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path

import pytest
from code_server_script import SCRIPT, or_skip

from rapidsim.module_files import MODULE_SUFFIXES

EXTENSION = Path(__file__).parents[2] / "editors" / "vscode"
GRAMMAR = EXTENSION / "syntaxes" / "rapid.tmLanguage.json"
MOST_LINES = 300
MOST_KB = 200


@pytest.mark.packages
def test_the_package_has_what_it_names(tmp_path: Path) -> None:
    package = or_skip(SCRIPT.package_extension, tmp_path)
    assert package.stat().st_size < MOST_KB * 1024
    with zipfile.ZipFile(package) as archive:
        names = {name.removeprefix("extension/") for name in archive.namelist()}
        about = json.loads(archive.read("extension/package.json"))
        licences = archive.read("extension/dist/LICENSES.txt").decode()
    assert {"dist/extension.js", "dist/LICENSES.txt", "LICENSE.txt", "readme.md"} <= names
    assert not [name for name in names if name.startswith(("src/", "node_modules/"))]
    language, grammar = about["contributes"]["languages"][0], about["contributes"]["grammars"][0]
    for path in (about["main"], language["configuration"], grammar["path"]):
        assert path.removeprefix("./") in names
    assert "vscode-languageclient\n" in licences


def test_the_source_is_small() -> None:
    files = sorted((EXTENSION / "src").glob("*.ts"))
    lines = [line for file in files for line in file.read_text(encoding="utf-8").splitlines()]
    assert len(lines) <= MOST_LINES


def test_the_extension_is_for_all_modules() -> None:
    about = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))
    language = about["contributes"]["languages"][0]
    assert sorted(language["extensions"]) == sorted(MODULE_SUFFIXES)
    licence = EXTENSION.parents[1] / "LICENSE"
    assert (EXTENSION / "LICENSE").read_bytes() == licence.read_bytes()


def test_launch_attributes_are_those_of_the_manual() -> None:
    about = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))
    launch = about["contributes"]["debuggers"][0]["configurationAttributes"]["launch"]
    page = (EXTENSION.parents[1] / "docs" / "debug.md").read_text(encoding="utf-8")
    table = page[page.index("| argument |") :].partition("\n\n")[0]
    names = [line.split("|")[1] for line in table.splitlines()]
    assert set(launch["properties"]) == set(re.findall(r"`(\w+)`", "".join(names)))


def test_the_grammar_knows_all_words_and_names_every_part() -> None:
    grammar = json.loads(GRAMMAR.read_text(encoding="utf-8"))
    patterns = json.dumps(grammar)
    rules = (EXTENSION.parents[1] / "grammars" / "rapid.lark").read_text(encoding="utf-8")
    words = set(re.findall(r'"([A-Z]{2,})"', rules))
    assert {"MODULE", "ENDTEST", "XOR", "NOSTEPIN"} <= words
    assert sorted(word for word in words if not re.search(rf"\b{word}\b", patterns)) == []
    included = set(re.findall(r'"include": "#(\w+)"', patterns))
    assert included == set(grammar["repository"])


def test_blocks_indent_what_is_in_them() -> None:
    configuration = json.loads(
        (EXTENSION / "language-configuration.json").read_text(encoding="utf-8")
    )
    rules = configuration["indentationRules"]
    more, less = (
        re.compile(rules[name]["pattern"], re.IGNORECASE)
        for name in ("increaseIndentPattern", "decreaseIndentPattern")
    )
    text = """MODULE m
  LOCAL PROC main()
    IF a>1 THEN ! why
      b:=1;
    ELSE
      FOR i FROM 1 TO 2 DO
        TPWrite "THEN";
      ENDFOR
    ENDIF
    IF a=1 b:=2;
    TEST a
    CASE 1, 2:
      WaitTime 1; ! DO
    DEFAULT:
      Stop;
    ENDTEST
  ERROR (1, 2)
    RETRY;
  ENDPROC
ENDMODULE
"""
    depth = 0
    for line in text.splitlines():
        depth -= 2 * bool(less.search(line))
        assert len(line) - len(line.lstrip()) == depth, line
        depth += 2 * bool(more.search(line))
