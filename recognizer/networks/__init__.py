"""Small neural networks in plain NumPy: their layers, and the one that sees motions."""
