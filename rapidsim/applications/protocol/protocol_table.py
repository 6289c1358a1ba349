"""Answers of a controller next to the answers of a run here."""

from __future__ import annotations

from rich.table import Table

from rapidsim.applications.protocol.protocol import TIMED, TOPICS, Protocol

_ANY_ERROR = "ERRNO "


def protocol_table(theirs: Protocol, ours: Protocol, arm: str) -> Table:
    """A row for each question; what differs is marked, of times by how much.

    Args:
        theirs: The answers of the controller.
        ours: The answers of a run here.
        arm: The arm of that run.
    """
    table = Table(box=None, pad_edge=False)
    table.add_column("question")
    table.add_column(f"{theirs.robot}, RobotWare {theirs.robotware}", overflow="fold")
    table.add_column(f"rapidsim, {arm}", overflow="fold")
    table.add_column("")
    for number, topic in TOPICS.items():
        answers = theirs.answers.get(number, "-"), ours.answers.get(number, "-")
        table.add_row(topic, *answers, _difference(number, theirs, *answers))
    return table


def _difference(number: int, protocol: Protocol, theirs: str, ours: str) -> str:
    if theirs == ours:
        return ""
    if theirs.startswith(_ANY_ERROR) and ours.startswith(_ANY_ERROR):
        # Numbers of errors are not published, and ours are our own.
        return "an error, too"
    if number in TIMED and (why := protocol.why_not_timed(number)):
        return f"not comparable: {why}"
    try:
        ratio = float(theirs) / float(ours) if number in TIMED else None
    except (ValueError, ZeroDivisionError):
        ratio = None
    return "differs" if ratio is None else f"{100.0 * (ratio - 1.0):+.1f} %"
