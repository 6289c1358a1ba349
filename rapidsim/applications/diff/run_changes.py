"""Differences between two runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from difflib import SequenceMatcher

from rapidsim.applications.diff.changes import OutputChange, RunChange, TimeChange
from rapidsim.applications.diff.run_record import RunRecord, RunStep
from rapidsim.diagnostics import Severity
from rapidsim.motion.robot.catalogue import entry_name
from rapidsim.simulation.results.simulation import End
from rapidsim.values import value_class

_ROUNDING_S = 1e-6
"""Tolerance [s]: runs of one program on two machines agree better than this."""
_SHOWN_S = 0.0005
_SHOWN_MM = 0.05


@value_class(frozen=True, slots=True)
class ProgramRun:
    """A run, and the path of its TCP, if known."""

    record: RunRecord
    position_mm: Callable[[float], Sequence[float]] | None = None


def run_changes(old: ProgramRun, new: ProgramRun) -> RunChange:
    """Compare two runs."""
    before, after = old.record, new.record
    a, b = before.steps, after.steps
    return RunChange(
        before_s=before.time_s,
        after_s=after.time_s,
        ends=(before.end.value, after.end.value),
        errors=(_error(before), _error(after)),
        robots=(entry_name(before.robot), entry_name(after.robot)),
        motion_models=(before.motion_model, after.motion_model),
        routines=tuple(_routine_changes(a, b)),
        lines=tuple(sorted(_line_changes(a, b), key=lambda one: -abs(one.delta_s))),
        outputs=tuple(_output_changes(old, new)),
    )


def _error(run: RunRecord) -> str | None:
    """Return the error that stopped a run; the last of several; None if no error stopped it."""
    if run.end is not End.ERROR:
        return None
    errors = [one for one in run.findings if one[0] == Severity.ERROR.value]
    return f"{errors[-1][1]}: {errors[-1][2]}" if errors else None


def _routine_changes(a: Sequence[RunStep], b: Sequence[RunStep]) -> Iterator[TimeChange]:
    before, after = _by_routine(a), _by_routine(b)
    names = {step.key[:2]: (step.task, step.routine) for step in (*a, *b)}
    for key, name in names.items():
        x, y = before.get(key), after.get(key)
        if x is None or y is None or abs(x - y) > _ROUNDING_S:
            yield TimeChange(*name, "", x, y)


def _by_routine(steps: Sequence[RunStep]) -> dict[tuple[str, ...], float]:
    sums: dict[tuple[str, ...], float] = {}
    for step in steps:
        sums[step.key[:2]] = sums.get(step.key[:2], 0.0) + step.seconds
    return sums


def _line_changes(a: Sequence[RunStep], b: Sequence[RunStep]) -> Iterator[TimeChange]:
    """Yield steps with another time, or executed in one run only; equal steps are added up."""
    sums: dict[tuple[str, str, str], tuple[float | None, float | None]] = {}
    matcher = SequenceMatcher(None, [x.key for x in a], [y.key for y in b], autojunk=False)
    pairs: list[tuple[RunStep | None, RunStep | None]] = []
    for word, a1, a2, b1, b2 in matcher.get_opcodes():
        if word == "equal":
            pairs += zip(a[a1:a2], b[b1:b2], strict=True)
        else:
            pairs += [(x, None) for x in a[a1:a2]]
            pairs += [(None, y) for y in b[b1:b2]]
    names = {step.key: step for step in (*a, *b)}
    for x, y in pairs:
        if x is None or y is None or abs(x.seconds - y.seconds) > _ROUNDING_S:
            key = y.key if x is None else x.key  # type: ignore[union-attr]
            before_s, after_s = sums.get(key, (None, None))
            before_s = _sum(before_s, x.seconds if x else None)
            sums[key] = before_s, _sum(after_s, y.seconds if y else None)
    for key, (before_s, after_s) in sums.items():
        if before_s is None or after_s is None or abs(before_s - after_s) > _ROUNDING_S:
            step = names[key]
            yield TimeChange(step.task, step.routine, step.text, before_s, after_s)


def _sum(a: float | None, b: float | None) -> float | None:
    return b if a is None else a if b is None else a + b


def _output_changes(old: ProgramRun, new: ProgramRun) -> Iterator[OutputChange]:
    before, after = _outputs(old.record), _outputs(new.record)
    for signal in sorted(dict.fromkeys((*before, *after)), key=str.lower):
        a, b = before.get(signal, []), after.get(signal, [])
        values_a, values_b = [value for _, value in a], [value for _, value in b]
        if values_a != values_b:
            yield OutputChange(signal, _other_values(a, b))
            continue
        told = [text for x, y in zip(a, b, strict=True) if (text := _elsewhere(x, y, old, new))]
        if told:
            more = f", and {len(told) - 1} more of its {len(a)} changes" if len(told) > 1 else ""
            yield OutputChange(signal, f"{told[0]}{more}")


def _outputs(run: RunRecord) -> dict[str, list[tuple[float, float]]]:
    found: dict[str, list[tuple[float, float]]] = {}
    for change in run.signals:
        found.setdefault(change.signal, []).append((change.time_s, change.value))
    return found


def _other_values(a: Sequence[tuple[float, float]], b: Sequence[tuple[float, float]]) -> str:
    if len(a) != len(b):
        return f"set {_times(len(b))} instead of {_times(len(a))}"
    first = next(n for n, (x, y) in enumerate(zip(a, b, strict=True)) if x[1] != y[1])
    return f"set to {b[first][1]:g} instead of {a[first][1]:g} at {b[first][0]:.3f} s"


def _times(count: int) -> str:
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")


def _elsewhere(
    x: tuple[float, float], y: tuple[float, float], old: ProgramRun, new: ProgramRun
) -> str:
    late_s = y[0] - x[0]
    told = []
    if abs(late_s) > _SHOWN_S:
        side = "later" if late_s > 0.0 else "earlier"
        told.append(f"{abs(late_s):.3f} s {side} ({x[0]:.3f} -> {y[0]:.3f} s)")
    if old.position_mm and new.position_mm:
        places = zip(old.position_mm(x[0]), new.position_mm(y[0]), strict=True)
        apart_mm = sum((p - q) ** 2 for p, q in places) ** 0.5
        if apart_mm > _SHOWN_MM:
            told.append(f"{apart_mm:.1f} mm elsewhere")
    return f"becomes {y[1]:g} {', '.join(told)}" if told else ""
