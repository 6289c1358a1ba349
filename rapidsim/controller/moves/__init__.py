"""From a move instruction to a segment: frames, speeds, zone and the configuration at its end."""
