"""JSON records, declared once as classes: their output, their schema, and reading them back."""
