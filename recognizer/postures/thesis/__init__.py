"""The thesis's own chain for a photo: skin, noise, hand, outline, seven numbers."""
