"""What the tasks of a cell share: signals, sockets, files, the operator; what changes by itself."""
