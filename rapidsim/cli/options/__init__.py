"""What commands are given, read and refused."""
