"""What they do: motions read from files, as one person performs them once."""
