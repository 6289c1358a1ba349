"""Check whether the arm can make every move in the program text, before the program runs."""
