"""`rapidsim protocol`: questions for a controller, and its answers beside ours."""
