"""The language server: what an editor asks of a workspace, and the wire."""
