"""Run-time support for generated code: values, memory, errors, late calls."""
