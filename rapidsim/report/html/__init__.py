"""A run as one HTML file that needs no network: to open, to mail, to keep."""
