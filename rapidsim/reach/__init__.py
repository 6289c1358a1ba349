"""Whether the arm can make every move in the program text, decided before anything runs."""
