"""What is learnt from labelled vectors: the database, a metric, neighbours, and when to reject."""
