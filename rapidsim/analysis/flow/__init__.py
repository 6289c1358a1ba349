"""Control flow of a routine: one graph, solved by worklists, summarised over calls."""
