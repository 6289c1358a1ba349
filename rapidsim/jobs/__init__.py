"""From what a user names to what is checked or run: shared by API and command line."""
