"""`rapidsim follow` and `rapidsim points`: motion along the points of a table."""
