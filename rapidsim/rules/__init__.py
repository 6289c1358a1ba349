"""What each rule says and shows: a folder a rule, read as text."""
