"""Ground stations: missions and commands that they send to the companion itself, and who gets which packet."""
