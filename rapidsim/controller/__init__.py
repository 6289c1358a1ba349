"""The virtual controller of one task: its clock, and one small class per concern."""
