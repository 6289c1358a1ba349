"""Output of a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rapidsim.jobs.running.sweep import Sweep


def swept_text(sweep: Sweep, written: Sequence[Path]) -> str:
    """Number of variants that work, the best of them, and the file of the table."""
    works, count = sweep.works, len(sweep.number)
    moves = "1 move" if sweep.moves == 1 else f"{sweep.moves} moves"
    lines = [f"{int(works.sum())} of {count} variants reach all of {moves} as programmed."]
    if not sweep.moves:
        lines.append("No move is known before the program runs, so reach was not checked.")
    if works.any():
        best = int(np.argmax(np.where(works, sweep.margin_deg, -np.inf)))
        if np.isfinite(sweep.margin_deg[best]):
            margin = f"{sweep.margin_deg[best]:.1f} {sweep.margin_measure}"
            lines.append(f"Farthest from its limits, by {margin}: {_place(sweep, best)}.")
        runs = [
            (one.time_s, row) for row, one in enumerate(sweep.runs) if one and one.end == "ended"
        ]
        ran = sum(one is not None for one in sweep.runs)
        if runs:
            time_s, row = min(runs)
            lines.append(f"{len(runs)} of {ran} runs reached their end.")
            lines.append(f"Fastest, in {time_s:.3f} s: {_place(sweep, row)}.")
        elif ran:
            lines.append(f"None of {ran} runs reached its end.")
    elif count:
        row = int(np.argmin(sweep.unreachable + sweep.other_configuration))
        lines.append(
            f"Closest to working: {_place(sweep, row)}, with {sweep.unreachable[row]} out of "
            f"reach, {sweep.other_configuration[row]} in another configuration."
        )
    if written:
        lines.append(f"Wrote {', '.join(map(str, written))}.")
    return "\n".join(lines)


def _place(sweep: Sweep, row: int) -> str:
    named = zip(sweep.axes, sweep.values[row].tolist(), strict=True)
    return ", ".join(f"{axis.key}={value:g}" for axis, value in named)
