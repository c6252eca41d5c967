"""The hand of a whole person in view: where it is, and what a small network sees in it."""
