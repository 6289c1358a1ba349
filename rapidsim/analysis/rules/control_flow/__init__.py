"""Rules about constant conditions, ineffective ERROR clauses, and modes that are not restored."""
