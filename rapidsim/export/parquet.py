"""Trace table as Apache Parquet, written in blocks of rows."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from rapidsim.export.table import RowBlock


def write_parquet(path: Path, names: tuple[str, ...], rows: Iterator[RowBlock]) -> None:
    """Write rows; `move` is a 64-bit integer, `task` a string, all other columns are doubles."""
    kinds = {"move": pa.int64(), "task": pa.string()}
    schema = pa.schema([(name, kinds.get(name, pa.float64())) for name in names])
    with pq.ParquetWriter(path, schema) as writer:
        for block in rows:
            rows_here = len(block.move)
            time_s, *rest = (
                pa.nulls(rows_here) if column is None else column for column in block.numbers
            )
            tasks = [] if block.task is None else [pa.array([block.task] * rows_here)]
            values = [time_s, pa.array(block.move), *rest, *tasks]
            writer.write_table(pa.table(values, schema=schema))
