"""How the weights that find the head are learned; nothing that answers needs it."""
