"""What people score beside the automatic proposal: sittings, blind or not, at a screen or on a sheet."""
