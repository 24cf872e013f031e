"""The command line: the only place that wires cores, drivers, recorder and the bundled vehicle together."""
