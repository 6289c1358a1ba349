"""Findings as text, JSON, SARIF, JUnit, GitHub."""
