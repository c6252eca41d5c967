"""The hand alone: divided from a plain background, in its own frame, described."""
