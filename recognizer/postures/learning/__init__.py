"""What is learnt from described hands, and from which photos or model hands."""
