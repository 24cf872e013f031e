"""What differs between autopilots, one module each: readiness, streams, modes, arming, landing. No I/O, no clock."""
