"""Columns of numbers as short JSON: integers, as differences of neighbours."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array


def packed(values: Array, digits: int) -> dict[str, object]:
    """A column (k,) with some digits behind the point; the page adds the steps up again.

    Whole numbers add up without error, and small steps are short texts: half the size of plain
    decimals. What is not finite becomes 0.
    """
    scale = 10**digits
    whole = np.rint(np.nan_to_num(values) * scale).astype(np.int64)
    return {"scale": scale, "steps": np.diff(whole, prepend=0).tolist()}


def packed_columns(values: Array, digits: int) -> list[dict[str, object]]:
    """The columns of a table (k, n)."""
    return [packed(values[:, k], digits) for k in range(values.shape[1])]
