"""From what a user names to what is checked or run: one way for API and command line."""
