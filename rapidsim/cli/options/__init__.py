"""Options of commands: declared, parsed and validated."""
