"""What RAPID predefines: routines, one file a chapter of the manual, and predefined data."""
