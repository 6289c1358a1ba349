"""The result of a calibration, as text with the lines for the station file, and as JSON."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.simulation.calibration.fit import Calibration, Fitted

_MEANINGS = {
    "acceleration_time": "axis speed / axis acceleration",
    "filter_time": "smoothing of the command",
    "fine_dwell": "at a stop point between moves",
}


def as_text(calibration: Calibration) -> RenderableType:
    """Tables of parameters and logs, and what to write into the station file."""
    fitted = Table(box=None, pad_edge=False)
    for title in ("parameter", "s", "+-", ""):
        fitted.add_column(title, justify="right" if title in ("s", "+-") else "left")
    for one in calibration.parameters:
        fitted.add_row(one.name, f"{one.value_s:.3f}", f"{one.uncertainty_s:.3f}", _remark(one))
    met = Table(box=None, pad_edge=False)
    for title in ("log", "rows", "time", "rms before", "after", "end before", "after"):
        met.add_column(title, justify="left" if title == "log" else "right")
    for log in calibration.logs:
        met.add_row(
            log.name,
            str(log.rows),
            f"{log.duration_s:.3f} s",
            f"{1e3 * log.rms_before_s:.1f} ms",
            f"{1e3 * log.rms_after_s:.1f} ms",
            f"{100.0 * log.end_before_s / log.duration_s:+.2f} %",
            f"{100.0 * log.end_after_s / log.duration_s:+.2f} %",
        )
    lines = "\n".join(
        f"{one.name} = {one.value_s:.3f}" for one in calibration.parameters if one.seen
    )
    advice = (
        Text(f"For rapidsim.toml:\n\n[motion]\n{lines}")
        if lines
        else Text("The logs say nothing about any of the three.")
    )
    return Group(fitted, Text(), met, Text(), advice)


def as_json(calibration: Calibration) -> dict[str, object]:
    """One object."""
    return {
        "schema": 1,
        "parameters": [
            {
                "name": one.name,
                "value_s": one.value_s,
                "uncertainty_s": one.uncertainty_s,
                "seen": one.seen,
            }
            for one in calibration.parameters
        ],
        "logs": [
            {
                "name": log.name,
                "rows": log.rows,
                "duration_s": log.duration_s,
                "rms_before_s": log.rms_before_s,
                "rms_after_s": log.rms_after_s,
                "end_before_s": log.end_before_s,
                "end_after_s": log.end_after_s,
            }
            for log in calibration.logs
        ],
    }


def _remark(one: Fitted) -> str:
    if one.seen:
        return _MEANINGS[one.name]
    return f"{_MEANINGS[one.name]}; these logs do not show it, kept near its default"
