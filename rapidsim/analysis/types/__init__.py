"""The types of expressions, and the types that contexts require."""
