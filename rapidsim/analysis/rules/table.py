"""The table of rules: each detector with the rules it finds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import Enum
from typing import TYPE_CHECKING

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.control_flow import (
    conditions,
    handlers,
    invariant_conditions,
    mode_leak,
    open_files,
    recursion,
    traps,
    unreleased,
    waits,
)
from rapidsim.analysis.rules.motion import (
    cumulative_displacement,
    first_move,
    orientations,
    target_data,
    tools,
    units,
    zones,
)
from rapidsim.analysis.rules.names import (
    late_names,
    never_set,
    optional_parameters,
    shadowing,
    unused,
    world_zones,
)
from rapidsim.analysis.rules.text import (
    array_loops,
    digital_values,
    numbers,
    strings,
    style,
    style_layout,
    text_rules,
    unsimulated,
)
from rapidsim.diagnostics import Diagnostic, Rule, Violation
from rapidsim.language.target_violations import QuaternionNotUnit
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers


class RuleScope(Enum):
    """The text on which the findings of a detector depend."""

    TEXT = "text"
    """The characters of one file."""
    FILE = "file"
    """The characters of one file and its tree."""
    ROUTINE = "routine"
    """One routine, or the declarations of one module, with the symbols and types in it.

    Declarations outside of routines may be looked up; no other routine is.
    """
    TASK = "task"
    """All files of the task; results for single routines come from `Facts.of_part`."""


@value_class(frozen=True, slots=True)
class Detector:
    """A function that detects some rules."""

    find: Callable[[Facts], Iterable[Diagnostic]]
    rules: tuple[type[Violation], ...]
    scope: RuleScope = RuleScope.ROUTINE
    of_targets: Callable[[Numbers], Mask] | None = None
    """Returns which targets (k,) of numbers (k, 17), as written, the detector has no reason to look
    at by themselves; None if it looks at no numbers of targets."""
    of_declared: Callable[[Numbers], Mask] | None = None
    """Returns which declared targets it has no reason to look at."""


DETECTORS = (
    Detector(unsimulated.find_unsupported, (unsimulated.UnsupportedConstruct,)),
    Detector(text_rules.find_bad_line_endings, (text_rules.BadLineEndings,), RuleScope.TEXT),
    Detector(text_rules.find_bad_encoding, (text_rules.BadEncoding,), RuleScope.TEXT),
    Detector(shadowing.find_shadowed, (shadowing.ShadowedName,), RuleScope.TASK),
    Detector(shadowing.find_redefined, (shadowing.RedefinedBuiltin,)),
    Detector(unused.find_unused_data, (unused.UnusedData,), RuleScope.TASK),
    Detector(unused.find_unused_routines, (unused.UnusedRoutine,), RuleScope.TASK),
    Detector(late_names.find_late_names, (late_names.AmbiguousLateBinding,), RuleScope.TASK),
    Detector(numbers.find_float_equality, (numbers.FloatEquality,)),
    Detector(numbers.find_long_integers, (numbers.NumIntegerPrecision,)),
    Detector(numbers.find_zero_divisors, (numbers.DivisionByConstantZero,)),
    Detector(array_loops.find_loops_beyond_arrays, (array_loops.LoopBeyondArray,)),
    Detector(digital_values.find_digital_values, (digital_values.DigitalValue,)),
    Detector(strings.find_long_texts, (strings.TextTooLong,)),
    Detector(world_zones.find_world_zones, (world_zones.WorldZoneOfRoutine,)),
    Detector(
        optional_parameters.find_absent_optionals,
        (optional_parameters.AbsentOptionalUsed,),
        RuleScope.TASK,
    ),
    Detector(conditions.find_constant_conditions, (conditions.ConstantCondition,)),
    Detector(conditions.find_endless_loops, (conditions.EndlessLoop,)),
    Detector(
        invariant_conditions.find_unchanging_conditions,
        (invariant_conditions.UnchangingCondition,),
        RuleScope.TASK,
    ),
    Detector(open_files.find_opened_in_loops, (open_files.OpenedInLoop,), RuleScope.TASK),
    Detector(conditions.find_not_before_and, (conditions.NotBeforeAnd,)),
    Detector(conditions.find_duplicate_cases, (conditions.DuplicateCase,)),
    Detector(conditions.find_tests_without_default, (conditions.TestWithoutDefault,)),
    Detector(
        handlers.find_careless_handlers, (handlers.RetryWithoutChange, handlers.SwallowedError)
    ),
    Detector(
        handlers.find_errors_that_fall_through,
        (handlers.ErrorFallsThrough, handlers.RaisedErrorFallsThrough),
        RuleScope.TASK,
    ),
    Detector(recursion.find_recursion, (recursion.Recursion,), RuleScope.TASK),
    Detector(mode_leak.find_mode_leaks, (mode_leak.ModeLeak,), RuleScope.TASK),
    Detector(unreleased.find_interrupts_left_off, (unreleased.InterruptsLeftOff,), RuleScope.TASK),
    Detector(unreleased.find_robot_left_stopped, (unreleased.RobotLeftStopped,), RuleScope.TASK),
    Detector(never_set.find_never_set, (never_set.ReadBeforeSet,), RuleScope.TASK),
    Detector(traps.find_trap_hazards, (traps.TrapHazard,)),
    Detector(traps.find_never_connected, (traps.NeverConnected,), RuleScope.TASK),
    Detector(
        orientations.find_bad_orientations,
        (QuaternionNotUnit,),
        of_targets=orientations.have_unit_length,
    ),
    Detector(zones.find_behind_zones, (zones.ZoneBeforeWait, zones.OutputInZone), RuleScope.TASK),
    Detector(tools.find_mixed_frames, (tools.ToolOrWobjMissing,), RuleScope.TASK),
    Detector(tools.find_bad_loads, (tools.BadLoadData,)),
    Detector(tools.find_holding_mismatch, (tools.StationaryToolMismatch,)),
    Detector(
        target_data.find_external_axes,
        (target_data.ExternalAxisValue,),
        RuleScope.TASK,
        of_declared=target_data.have_equal_axes,
    ),
    Detector(
        target_data.find_bad_confdata,
        (target_data.BadConfdata,),
        of_declared=target_data.have_good_confdata,
    ),
    Detector(target_data.find_duplicates, (target_data.DuplicateTargets,), RuleScope.TASK),
    Detector(
        units.find_metres,
        (units.MetresOrRadians,),
        RuleScope.TASK,
        of_targets=units.are_away_from_base,
    ),
    Detector(units.find_slow_speeds, (units.MetresOrRadians,), RuleScope.TASK),
    Detector(units.find_radians, (units.MetresOrRadians,)),
    Detector(
        cumulative_displacement.find_drifting_targets,
        (cumulative_displacement.DriftingTarget,),
        RuleScope.TASK,
    ),
    Detector(first_move.find_first_move, (first_move.FirstMoveLinear,), RuleScope.TASK),
    Detector(first_move.find_moves_without_speed, (first_move.MoveWithoutSpeed,)),
    Detector(waits.find_waits_without_timeout, (waits.WaitWithoutTimeout,)),
    Detector(style.find_keyword_case, (style.KeywordCase,), RuleScope.TEXT),
    Detector(style_layout.find_indentation, (style_layout.Indentation,), RuleScope.FILE),
    Detector(style_layout.find_trailing_space, (style_layout.TrailingSpace,), RuleScope.TEXT),
    Detector(style_layout.find_blank_lines, (style_layout.BlankLines,), RuleScope.TEXT),
    Detector(style_layout.find_final_newline, (style_layout.FinalNewline,), RuleScope.TEXT),
    Detector(style_layout.find_long_lines, (style_layout.LineTooLong,), RuleScope.FILE),
    Detector(style.find_long_routines, (style.LongRoutine,)),
    Detector(style.find_commented_out, (style.CommentedOutCode,), RuleScope.FILE),
    Detector(style.find_inline_targets, (style.InlineTarget,)),
)


def scope_of(find: Callable[[Facts], Iterable[Diagnostic]]) -> RuleScope:
    """Return the scope of a detector; that of a function outside of the table is the task."""
    return next((one.scope for one in DETECTORS if one.find is find), RuleScope.TASK)


def violations_of(find: Callable[[Facts], Iterable[Diagnostic]]) -> tuple[type[Violation], ...]:
    """Return what a detector finds; nothing for a function outside of the table."""
    return next((one.rules for one in DETECTORS if one.find is find), ())


def detectors_of(
    is_wanted: Callable[[Rule], bool] = lambda rule: rule.on_by_default,
) -> tuple[Callable[[Facts], Iterable[Diagnostic]], ...]:
    """Return the detectors for some rules; by default, for the rules that are on by default."""
    return tuple(
        detector.find
        for detector in DETECTORS
        if any(is_wanted(broken.rule) for broken in detector.rules)
    )
