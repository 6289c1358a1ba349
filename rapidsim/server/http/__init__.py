"""The protocols: addresses, sessions, bodies, websockets."""
