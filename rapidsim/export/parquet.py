"""The trace table as Apache Parquet, a block of rows at a time."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from rapidsim.export.table import Block


def write_parquet(path: Path, names: tuple[str, ...], rows: Iterator[Block]) -> None:
    """Write rows; `move` is a 64-bit integer, `task` a text, everything else a double."""
    kinds = {"move": pa.int64(), "task": pa.string()}
    schema = pa.schema([(name, kinds.get(name, pa.float64())) for name in names])
    with pq.ParquetWriter(path, schema) as writer:
        for block in rows:
            time_s, *rest = block.numbers.T
            tasks = [] if block.task is None else [pa.array([block.task] * len(block.move))]
            values = [time_s, pa.array(block.move), *rest, *tasks]
            writer.write_table(pa.table(values, schema=schema))
