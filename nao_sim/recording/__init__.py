"""Rerun recordings of episodes."""

import os

# Rerun's core reads this when it is first imported, and says on standard error what it also raises.
os.environ.setdefault("RUST_LOG", "off")
