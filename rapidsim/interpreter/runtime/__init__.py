"""What generated code uses at run time: values, memory, errors, late calls."""
