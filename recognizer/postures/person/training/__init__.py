"""How hands of persons in view are found is learnt here; nothing that answers needs it."""
