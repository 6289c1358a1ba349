"""The JSON Schemas of what the commands print as JSON."""

from __future__ import annotations

import json
from typing import Any

from rapidsim.files import InputError, did_you_mean
from rapidsim.shipped import shipped


def json_schema(name: str) -> dict[str, Any]:
    """The JSON Schema (draft 2020-12) of an output.

    What a schema lists is stable: keys keep their names, units and meaning while the number
    `schema` in the output stays the same. New keys may be added at any time.

    Args:
        name: `run`, `check`, `kin-fk`, `kin-ik`, `kin-jacobian`, `robots`, `robots-for`, `robot`,
            `frames`, `diff`, `follow`, `follow-compare`, `calibrate`,
            `protocol` or `error`.

    Raises:
        InputError: If no schema has that name.
    """
    names = [file.stem for file in shipped("schemas").glob("*.json")]
    if name not in names:
        cure = did_you_mean(name, names) or f"there are {', '.join(sorted(names))}"
        raise InputError(f"there is no schema `{name}`", cure)
    text = (shipped("schemas") / f"{name}.json").read_text(encoding="utf-8")
    schema: dict[str, Any] = json.loads(text)
    return schema
