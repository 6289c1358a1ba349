"""Rules that only a check applies, for code that is legal yet likely wrong."""
