"""The same curves in joints, over one path parameter s."""
