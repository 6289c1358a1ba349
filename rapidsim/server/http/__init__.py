"""HTTP protocols: addresses, sessions, representations, websockets."""
