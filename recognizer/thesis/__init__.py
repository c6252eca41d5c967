"""The thesis's own way with clips, kept as a baseline: key frames, ellipses, its vectors and rules."""
