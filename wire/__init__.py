"""The leaf both speakers share: endpoint URLs, UDP sockets, and framing of MAVLink datagrams. Framing, never meaning."""
