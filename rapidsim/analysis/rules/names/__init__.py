"""Names and data that nothing uses, sets or can see."""
