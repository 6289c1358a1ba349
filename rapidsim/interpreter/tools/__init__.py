"""What coverage, debugger and assertions ask of a program."""
