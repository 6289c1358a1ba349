"""Contents of the cell view: arms, tools, targets, paths and bodies."""
