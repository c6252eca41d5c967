"""Frames: read from files, taken at a steady rate, made smaller, and watched for cuts."""
