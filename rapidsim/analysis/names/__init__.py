"""What a name means, what a task declares."""
