"""Resources of a controller by address, with one description of each for all protocols."""
