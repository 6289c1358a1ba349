"""Pictures of a run for papers and slides; the only room that imports matplotlib."""
