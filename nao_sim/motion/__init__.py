"""Trajectories, whole-body kinematics, balance, walking, getting up."""
