"""What can be asked of a controller by address; one description of each, for all faces."""
