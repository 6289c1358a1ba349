"""Page on a controller event or an error name of RAPID: number, title, names, rules."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Rule
from rapidsim.language.error_numbers import EVENTS, NUMBERS
from rapidsim.language.events import EVENT_TITLES
from rapidsim.report.palette import Palette


def error_name(text: str) -> str | None:
    """The error name as RAPID writes it; None if the text is not an error name."""
    return next((name for name in NUMBERS if name.lower() == text.lower()), None)


def event_of_name(name: str) -> int | None:
    """The event of an error name; None if it has none that is known."""
    return EVENTS.get(NUMBERS[name])


def event_page(number: int, rules: Sequence[Rule], palette: Palette) -> str:
    """The page of an event: title, error names, the rules that cite it.

    Args:
        number: Of the event.
        rules: The rules that cite the event.
        palette: Colours.
    """
    title = EVENT_TITLES.get(number, "an event that rules cite")
    lines = [f"{palette.paint(str(number), palette.strong)} {title}"]
    names = [name for name, errno in NUMBERS.items() if EVENTS.get(errno) == number]
    if names:
        lines.append(f"In an ERROR clause: {', '.join(f'ERRNO={name}' for name in names)}")
    if rules:
        lines.append(f"Found by: {', '.join(f'{rule.code} {rule.name}' for rule in rules)}")
    return "\n".join(lines)


def name_page(name: str, palette: Palette) -> str:
    """The page of an error name whose event is not known."""
    return (
        f"{palette.paint(name, palette.strong)} is an error that ERROR clauses can answer: "
        f"ERRNO={name}\nThe controller's event number for it is not known here."
    )
