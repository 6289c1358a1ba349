"""Externally guided motion (EGM) on the wire: messages, datagrams, and the processes involved."""
