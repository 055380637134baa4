//! What the drives get: coordinates and pulses.
