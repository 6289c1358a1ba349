"""What is known at each statement of a program without running it."""
