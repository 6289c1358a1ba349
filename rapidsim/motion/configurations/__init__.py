"""Which joint vector a pose means: frames, confdata, reach, singularities."""
