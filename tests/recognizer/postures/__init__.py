"""Static hand postures."""
