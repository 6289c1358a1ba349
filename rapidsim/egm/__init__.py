"""Externally guided motion on the wire: messages, datagrams, and who answers them."""
