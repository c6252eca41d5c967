"""The simulated NAO: joints, motors, sensors, postures."""
