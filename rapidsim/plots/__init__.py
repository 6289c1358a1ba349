"""A run as pictures for papers and slides; the only room that imports matplotlib."""
