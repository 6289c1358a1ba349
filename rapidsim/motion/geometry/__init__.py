"""Programmed geometry: lines, arcs and joint moves of the TCP, and the blends between them."""
