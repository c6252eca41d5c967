"""Rerun recordings of episodes."""
