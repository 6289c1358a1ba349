"""The resources of a controller by address; one description of each, for all protocols."""
