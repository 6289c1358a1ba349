"""Shapes from files: STL, OBJ, PLY and glTF become triangles, bounded and checked."""
