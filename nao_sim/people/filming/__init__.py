"""Where and how they are filmed: room, light, camera and sensor, and the clips and photos that come of it."""
