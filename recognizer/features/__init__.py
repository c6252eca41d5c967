"""From what was seen of the person, step by step, to the vector that describes a clip."""
