"""Gesture files: loading, checking, exchanging."""
