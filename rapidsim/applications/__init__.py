"""Commands that the core does without, each in a folder that knows none of the others."""
