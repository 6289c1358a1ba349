"""Reading RAPID source files: bytes from a controller to text, never a failure."""

from __future__ import annotations
