"""What a program may not exceed to be executed."""
