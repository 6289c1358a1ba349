"""What a check says of a text: the modules of `text.txt`, and all that is said of each.

A section of that file may begin with a station file, up to a line `--`, whose first line may hold
arguments of the command behind `$`, in place of `--no-merge`; then come the items of a module, and
behind `|| NAME` those of another one.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from check_helper import HERE
from command_line import call
from whole_findings import assert_section, sections, whole

PROGRAMS = sections(HERE / "text.txt")


def told(folder: Path, section: str) -> str:
    """What a check says of the modules of a section."""
    station, _, text = section.rpartition("--\n")
    arguments, _, station = station.partition("\n") if station[:1] == "$" else ("", "", station)
    for module in f"cell\n{text}".split("|| "):
        name, _, items = module.partition("\n")
        (folder / f"{name}.mod").write_text(f"MODULE {name}\n{items}ENDMODULE\n")
    (folder / "rapidsim.toml").write_text(station)
    more = arguments[1:].split() or ["--no-merge"]
    ended = call("check", ".", "--no-reach", "--output-format", "json", *more, cwd=folder)
    found = json.loads(ended.out)
    if "error" in found:
        return f"{found['error']}\n"
    verdict = "ok" if found["ok"] else "not ok"
    return whole(found["diagnostics"]) + f"{verdict}: {'; '.join(found['qualifications'])}\n"


@pytest.mark.parametrize("name", PROGRAMS)
def test_all_that_a_check_says_of_a_text(name: str, tmp_path: Path) -> None:
    text = told(tmp_path, PROGRAMS[name]).replace(f"{tmp_path}/", "")
    assert_section(HERE / "findings" / "text.txt", name, text)
