"""From a move instruction to a segment: frames, speeds, zone, and how the arm arrives."""
