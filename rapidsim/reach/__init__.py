"""Can the arm make every move of the text? Answered before anything runs."""
