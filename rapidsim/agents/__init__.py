"""Tools for agents that write RAPID, under the Model Context Protocol."""
