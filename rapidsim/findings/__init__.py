"""What a check of motion or a run can say: one small class a rule, with its page."""
