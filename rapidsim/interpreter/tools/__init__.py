"""What coverage, debugger and assertions need from a program."""
