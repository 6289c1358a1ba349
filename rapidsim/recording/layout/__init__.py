"""How the viewer lays it out, and writing it all."""
