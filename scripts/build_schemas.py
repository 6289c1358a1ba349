"""Write `rapidsim/schemas/` from the records: `python scripts/build_schemas.py`.

A file is the JSON Schema of what a command prints with `--format json`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from rapidsim.applications.calibrate.report import CalibrationReport
from rapidsim.applications.diff.changes import ComparisonReport
from rapidsim.applications.follow.follow_json import FollowComparison, FollowReport
from rapidsim.applications.kin.kin_json import ForwardReport, InverseReport, JacobianReport
from rapidsim.applications.protocol.protocol import Protocol
from rapidsim.cli.commands.frames import FramesReport
from rapidsim.cli.machine_output import ErrorReport, TextReport
from rapidsim.json_records.schema import Schema, SchemaWriter
from rapidsim.report.findings.check_report import CheckReport
from rapidsim.report.run.json_report import RunReport
from rapidsim.report.tables.ranking_table import RankingReport
from rapidsim.report.tables.robot_records import CatalogueReport, RobotPageRecord

FOLDER = Path(__file__).parents[1] / "rapidsim" / "schemas"
DRAFT = "https://json-schema.org/draft/2020-12/schema"
ERROR = "error"
WIDTH = 120
"""Characters of a line that a value may fill."""
OUTPUTS: Mapping[str, tuple[str, type[Any]]] = {
    "calibrate": ("calibrate", CalibrationReport),
    "check": ("check", CheckReport),
    "diff": ("diff", ComparisonReport),
    "follow": ("follow", FollowReport),
    "follow-compare": ("follow --compare", FollowComparison),
    "frames": ("frames", FramesReport),
    "kin-fk": ("kin fk", ForwardReport),
    "kin-ik": ("kin ik", InverseReport),
    "kin-jacobian": ("kin jacobian", JacobianReport),
    "protocol": ("protocol", Protocol),
    "robot": ("robots NAME", RobotPageRecord),
    "robots": ("robots", CatalogueReport),
    "robots-for": ("robots --for PATH", RankingReport),
    "run": ("run", RunReport),
}
"""Title and record of the output of each command, by the name of its schema."""


def schemas() -> Iterator[tuple[str, str]]:
    """Yield name and text of each schema."""
    yield ERROR, _text(_error_schema()) + "\n"
    for name, (title, record) in OUTPUTS.items():
        yield name, _text(_output_schema(title, record)) + "\n"


def _error_schema() -> Schema:
    writer = SchemaWriter()
    title = "rapidsim --format json, where a command cannot do its work"
    return {"$schema": DRAFT, "title": title, **writer.object_of(ErrorReport), **_defs(writer)}


def _output_schema(title: str, record: type[Any]) -> Schema:
    """Return the schema of an output, which may also be an error or the text of `--help`."""
    writer = SchemaWriter()
    error, text, output = map(writer.object_of, (ErrorReport, TextReport, record))
    return {
        "$schema": DRAFT,
        "title": f"rapidsim {title} --format json",
        "type": "object",
        "properties": output["properties"] | error["properties"] | text["properties"],
        "if": {"anyOf": [{"required": ["error"]}, {"required": ["text"]}]},
        "then": {"required": [key for key in output["required"] if key == "schema"]},
        "else": {"required": output["required"]},
        **_defs(writer),
    }


def _defs(writer: SchemaWriter) -> Schema:
    return {"$defs": dict(sorted(writer.definitions.items()))}


def _text(value: object, indent: str = "") -> str:
    """Return JSON in which a value that fits is one line."""
    line = json.dumps(value)
    if not isinstance(value, dict | list) or len(line) <= WIDTH - len(indent):
        return line
    inner = f"{indent}  "
    if isinstance(value, dict):
        begin, end = "{", "}"
        parts = [f"{json.dumps(key)}: {_text(one, inner)}" for key, one in value.items()]
    else:
        begin, end = "[", "]"
        parts = [_text(one, inner) for one in value]
    rows = f",\n{inner}".join(parts)
    return f"{begin}\n{inner}{rows}\n{indent}{end}"


def main() -> None:
    """Write the files."""
    for name, text in schemas():
        (FOLDER / f"{name}.json").write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
