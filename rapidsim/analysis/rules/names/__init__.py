"""Names and data nobody uses, sets or can see."""
