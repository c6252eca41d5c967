"""Other tools' files out and in: ELAN, BORIS, DREAM, BIDS, CSV as people have it."""
