"""Verdicts on the assertions and the cycle budget of a run, as text and as records of JSON."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.verdict import Verdict, run_verdict
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class AssertionVerdict:
    """One assertion."""

    expression: str
    task: str
    """Task whose data the assertion names."""
    holds: bool | None
    """None where it was not judged."""
    values: Mapping[str, str]
    """Values of the data and calls in it, by their text."""
    reason: str | None
    """Why it was not judged or could not be evaluated."""

    @property
    def text(self) -> str:
        """One line for a person."""
        if self.holds is None:
            return f"assertion not evaluated: {self.expression}, {self.reason}"
        if self.holds:
            return f"assertion holds: {self.expression}"
        parts = [
            f"{text} is {value}" for text, value in self.values.items() if text != self.expression
        ]
        if self.reason is not None:
            parts.insert(0, self.reason)
        return ", ".join([f"assertion failed: {self.expression}", *parts])


@value_class(frozen=True, slots=True)
class BudgetVerdict:
    """Verdict on the cycle budget of the station file."""

    budget_s: float
    cycle_s: float | None
    """Mean cycle time; None if the run has no full cycle."""
    cycles: int
    motion_model: str
    """Version of the motion model: times of another are not comparable."""
    holds: bool | None
    """None where it was not judged."""
    reason: str | None
    """Why the run has no full cycle."""

    @property
    def text(self) -> str:
        """One line for a person."""
        budget = f"the budget is {self.budget_s:g} s"
        if self.cycle_s is None:
            return f"cycle budget not checked: {self.reason}; {budget}"
        many = self.cycles > 1
        took = f"{f'each of {self.cycles} cycles takes' if many else 'the cycle takes'} "
        took += f"{self.cycle_s:.3f} s{' on average' if many else ''}"
        if self.holds:
            return f"cycle budget kept: {took}; {budget}"
        # A cycle may be over by less than the digits of its time show.
        over = f"{self.cycle_s - self.budget_s:.3g} s over it"
        return (
            f"cycle budget failed: {took} with motion model {self.motion_model}; {budget}: {over}"
        )


@value_class(frozen=True, slots=True)
class Verdicts:
    """The verdicts on a run."""

    assertions: tuple[AssertionVerdict, ...] = ()
    budget: BudgetVerdict | None = None

    @property
    def failed(self) -> bool:
        """Whether anything does not hold."""
        return any(one.holds is False for one in self.verdicts)

    def verdict_of(self, simulation: Simulation) -> Verdict:
        """Verdict of a run with its assertions; a strict run fails on open ones."""
        count = sum(one.holds is None for one in self.verdicts) if simulation.strict else 0
        still_open = (f"{count} of {len(self.verdicts)} assertions not evaluated",)
        return run_verdict(
            simulation, assertions_fail=self.failed, reservations=still_open if count else ()
        )

    @property
    def verdicts(self) -> tuple[AssertionVerdict | BudgetVerdict, ...]:
        """All of them, in the order of the command line, the budget last."""
        return (*self.assertions, *((self.budget,) if self.budget else ()))


NOTHING_ASKED = Verdicts()
