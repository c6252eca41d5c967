"""Watching people: what they did on a film, and when they began and ended."""
