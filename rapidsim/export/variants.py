"""Table of the variants of a sweep: one row per variant, as Parquet or CSV."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.jobs.running.sweep import Sweep
from rapidsim.output_files import whole_file

_ROWS_AT_ONCE = 50_000


def write_variants(sweep: Sweep, path: Path) -> Path:
    """Write the variants.

    Columns: `variant`, one per varying key [mm or deg], `moves`, `unreachable`,
    `other_configuration`, `margin_deg`, and for simulated variants `end`, `time_s`, `findings`.
    Unknown values are null, in CSV empty.

    Raises:
        InputError: If the file cannot be written, or has another suffix.
    """
    suffix = path.suffix.lower()
    if suffix not in (".parquet", ".csv"):
        raise InputError(
            f"cannot determine the format of the table `{path}` from its suffix",
            "use .parquet or .csv",
        )
    if suffix == ".parquet":
        require("pyarrow", "a table as Parquet")
    with whole_file(path) as temporary:
        if suffix == ".csv":
            _write_csv(sweep, temporary)
        else:
            _write_parquet(sweep, temporary)
    return path


def _columns(sweep: Sweep, rows: slice) -> dict[str, list[object]]:
    """Return some rows as columns; None for unknown values."""
    margins = sweep.margin_deg[rows]
    runs = sweep.runs[rows]
    return {
        "variant": sweep.number[rows].tolist(),
        **{axis.key: sweep.values[rows, column].tolist() for column, axis in enumerate(sweep.axes)},
        "moves": [sweep.moves] * len(runs),
        "unreachable": sweep.unreachable[rows].tolist(),
        "other_configuration": sweep.other_configuration[rows].tolist(),
        "margin_deg": [one if np.isfinite(one) else None for one in margins.tolist()],
        "end": [None if one is None else one.end for one in runs],
        "time_s": [None if one is None else one.time_s for one in runs],
        "findings": [None if one is None else one.findings for one in runs],
    }


def _write_csv(sweep: Sweep, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_columns(sweep, slice(0, 0)))
        for first in range(0, len(sweep.number), _ROWS_AT_ONCE):
            columns = _columns(sweep, slice(first, first + _ROWS_AT_ONCE))
            writer.writerows(zip(*columns.values(), strict=True))


def _write_parquet(sweep: Sweep, path: Path) -> None:
    import pyarrow as pa  # noqa: PLC0415 - Optional package.
    import pyarrow.parquet as pq  # noqa: PLC0415

    whole = {"variant", "moves", "unreachable", "other_configuration", "findings"}
    kinds = {name: pa.int64() for name in whole} | {"end": pa.string()}
    names = _columns(sweep, slice(0, 0))
    schema = pa.schema([(name, kinds.get(name, pa.float64())) for name in names])
    with pq.ParquetWriter(path, schema) as writer:
        for first in range(0, len(sweep.number), _ROWS_AT_ONCE):
            columns = _columns(sweep, slice(first, first + _ROWS_AT_ONCE))
            writer.write_table(pa.table(columns, schema=schema))
