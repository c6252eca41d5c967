"""Walking: footsteps, preview control, leg kinematics, feedback."""
