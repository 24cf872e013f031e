"""The vehicle's own pace, read from the time since boot in its messages (being filled)."""
