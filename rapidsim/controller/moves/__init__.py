"""Resolution of move instructions to segments: frames, speeds, zone, end configuration."""
