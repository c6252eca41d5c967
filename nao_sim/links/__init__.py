"""Connections to other programs and robots."""
