"""Links modules into functions that can call each other, and loads and unloads them at run time."""
