"""Findings for a person: source frames in the terminal's colours and width."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.cli.terminal import Terminal
from rapidsim.report.findings.merging import Finding
from rapidsim.report.findings.text import full


def findings_text(findings: Sequence[Finding], terminal: Terminal) -> str:
    """The findings as text that ends in a line end, where there is any."""
    return full(findings, terminal.palette, width=terminal.width, headlines=terminal.headline_width)
