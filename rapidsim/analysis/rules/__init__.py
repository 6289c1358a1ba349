"""Rules that only a check applies: legal and yet likely wrong. Their facts, and their table."""
