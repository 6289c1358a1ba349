"""Tree to program: names, types, flow; whoever holds a `Program` holds one without errors."""
