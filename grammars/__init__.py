"""The grammar of RAPID, as data."""
