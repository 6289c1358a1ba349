"""Conversion of poses to joint vectors: frames, confdata, reach, singularities."""
