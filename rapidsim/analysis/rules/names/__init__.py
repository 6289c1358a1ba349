"""Rules about names and data that are unused, never set or hidden."""
