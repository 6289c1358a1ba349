"""Moved to `rapidsim.interpreter.tools.coverage_plugin`; this alias goes in the next release."""

from rapidsim.interpreter.tools.coverage_plugin import coverage_init as coverage_init
