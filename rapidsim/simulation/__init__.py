"""One run of tasks on one clock, from programs and robots to a result."""
