"""Where the person is: the head found, followed and measured, and windows of its size around it."""
