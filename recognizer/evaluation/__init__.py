"""How well: data sets in, databases and scores on unseen persons out."""
