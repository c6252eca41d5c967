"""Simulated people on video, and data sets of clips."""
