"""Where seeing and moving meet: imitation episodes and their storage."""
