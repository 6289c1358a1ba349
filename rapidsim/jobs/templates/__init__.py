"""Templates of station files, from programs."""
