"""What rules ask of a program beside its facts."""
