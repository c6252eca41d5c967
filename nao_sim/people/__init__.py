"""People on video: rendered actors, the clips they are filmed in, and data sets of such clips."""
