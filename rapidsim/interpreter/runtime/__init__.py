"""What generated code finds when it runs: values, memory, errors, late calls."""
