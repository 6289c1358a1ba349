"""`rapidsim diff`: comparison of two programs, and of their runs."""
