"""The result of a calibration, as text with the lines for the station file, and as JSON."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.applications.calibrate.fit import Calibration, Fitted, LogFit
from rapidsim.json_records.declarations import OutputRecord
from rapidsim.json_records.encoding import json_of
from rapidsim.values import value_class

_MEANINGS = {
    "torque": "factor on the known torque of the axis",
    "wrist": "factor on the accelerations of axes 4 to 6",
    "acceleration_time": "axis speed / axis acceleration",
    "filter_time": "smoothing of the command",
    "fine_dwell": "dwell at a stop point between moves",
    "zone_share": "share of torques and accelerations used in a zone",
}


def as_text(calibration: Calibration) -> RenderableType:
    """Tables of parameters and logs, and what to write into the station file."""
    fitted = Table(box=None, pad_edge=False)
    for title in ("parameter", "before", "now", "+-", ""):
        fitted.add_column(title, justify="right" if title in ("before", "now", "+-") else "left")
    for one in calibration.parameters:
        unit = " s" if one.value_s is not None else ""
        values = (one.start, one.value, one.uncertainty)
        fitted.add_row(one.name, *(f"{value:.3f}{unit}" for value in values), _remark(one))
    met = Table(box=None, pad_edge=False)
    titles = ("log", "rows", "time", "rms before", "after", "left out")
    for title in (*titles, "end before", "after", "left out"):
        met.add_column(title, justify="left" if title == "log" else "right")
    for log in calibration.logs:
        met.add_row(
            log.name,
            str(log.rows),
            f"{log.duration_s:.3f} s",
            *(_ms(one) for one in (log.rms_before_s, log.rms_after_s, log.rms_left_out_s)),
            *(
                _share(one, log.duration_s)
                for one in (log.end_before_s, log.end_after_s, log.end_left_out_s)
            ),
        )
    lines = _lines(calibration)
    advice = (
        Text(f"For rapidsim.toml:\n\n{lines}")
        if lines
        else Text("The logs determine none of them.")
    )
    explained = Text("left out: predicted from the other logs alone", "dim")
    return Group(fitted, Text(), met, explained, Text(), advice)


def _lines(calibration: Calibration) -> str:
    """Block for the station file: the parameters fitted to the logs."""
    tables: dict[str, dict[str, list[float]]] = {}
    for one in calibration.parameters:
        tables.setdefault(one.table, {}).setdefault(one.key, []).append(
            one.value if one.seen else one.start
        )
    seen = {(one.table, one.key) for one in calibration.parameters if one.seen}
    written = []
    for table, keys in tables.items():
        rows = [f"{key} = {_value(values)}" for key, values in keys.items() if (table, key) in seen]
        if rows:
            written.append("\n".join((f"[{table}]", *rows)))
    return "\n\n".join(written)


def _value(values: list[float]) -> str:
    texts = [f"{value:.3f}" for value in values]
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def _ms(seconds: float | None) -> str:
    return "" if seconds is None else f"{1e3 * seconds:.1f} ms"


def _share(seconds: float | None, whole_s: float) -> str:
    return "" if seconds is None else f"{100.0 * seconds / whole_s:+.2f} %"


@value_class(frozen=True, slots=True)
class CalibrationReport(OutputRecord):
    """The object that `rapidsim calibrate --format json` prints."""

    parameters: tuple[Fitted, ...]
    logs: tuple[LogFit, ...]


def as_json(calibration: Calibration) -> dict[str, object]:
    """One object."""
    return json_of(CalibrationReport(calibration.parameters, calibration.logs))


def _remark(parameter: Fitted) -> str:
    meaning = _MEANINGS[parameter.key]
    if not parameter.seen:
        return f"{meaning}; these logs do not determine it, so it stays close to the known value"
    if parameter.contradicts:
        return f"{meaning}; another value was measured on an arm of this type: check the logs"
    return meaning
