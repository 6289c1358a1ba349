"""Answers of a controller beside those of a run here."""

from __future__ import annotations

from rich.table import Table

from rapidsim.jobs.protocol import TOPICS, Protocol


def protocol_table(theirs: Protocol, ours: Protocol) -> Table:
    """A row for each question; what differs is marked."""
    table = Table(box=None, pad_edge=False)
    table.add_column("question")
    table.add_column(f"{theirs.robot}, RobotWare {theirs.robotware}", overflow="fold")
    table.add_column("rapidsim", overflow="fold")
    table.add_column("")
    for number, topic in TOPICS.items():
        answers = theirs.answers.get(number, "-"), ours.answers.get(number, "-")
        table.add_row(topic, *answers, "" if answers[0] == answers[1] else "differs")
    return table
