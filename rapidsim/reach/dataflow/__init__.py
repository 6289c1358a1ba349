"""What is known of a program where each statement stands, without running it."""
