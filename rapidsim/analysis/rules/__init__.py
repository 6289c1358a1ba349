"""Rules that only `rapidsim check` applies: legal and yet likely wrong. Start at `table.py`."""
