"""Shapes from files: STL, OBJ, PLY, glTF and STEP become triangles, bounded and checked."""
