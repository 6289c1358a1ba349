"""The texts of a cell, also unsaved ones, and the findings in them after each change."""
