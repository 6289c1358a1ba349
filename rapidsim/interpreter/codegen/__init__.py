"""A checked routine becomes Python syntax."""
