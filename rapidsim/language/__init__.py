"""The facts of RAPID that program analysis and motion share: types, values, errors."""
