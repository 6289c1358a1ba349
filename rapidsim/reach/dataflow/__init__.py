"""Static analysis of the values at each statement of a program."""
