"""What a controller backup says of its station."""
