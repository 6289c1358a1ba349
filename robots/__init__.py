"""The robots that ship with rapidsim, as data."""
