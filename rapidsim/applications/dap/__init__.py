"""`rapidsim dap`: a debug adapter for editors."""
