"""What moves in pictures: optical flow, moving regions, and how far they go."""
