"""Looking at a session: film and robot side by side, and its story on one time line."""
