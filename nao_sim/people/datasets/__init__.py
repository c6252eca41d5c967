"""Data sets of clips: what is filmed, the manifest, own recordings, checks, samples, and where heads truly are."""
