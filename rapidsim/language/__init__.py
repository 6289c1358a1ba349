"""The facts of RAPID that both the text half and the motion half need: types, values, errors."""
