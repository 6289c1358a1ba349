"""What an expression is, and what its place takes."""
