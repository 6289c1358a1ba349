"""State shared by the tasks of a cell: signals, sockets, files, the operator; its timed changes."""
