"""The companion as a service: its configuration, its loop from mission to mission, its page and its log."""
