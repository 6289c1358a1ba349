"""Pages of the manual, made from the tables of rules and routines."""
