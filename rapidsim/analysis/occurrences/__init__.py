"""Names in a text with their symbols: at an offset, all of one symbol, in scope, renamed."""
