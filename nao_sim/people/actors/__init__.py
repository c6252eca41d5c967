"""Who is on the video: bodies, looks and clothes, drawn from a seed and laid over one skeleton."""
