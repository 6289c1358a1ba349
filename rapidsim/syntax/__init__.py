"""Text to tree: lexing, parsing, repair of syntax errors."""
