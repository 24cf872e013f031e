"""Other people's mission files: QGroundControl's `.plan` and `QGC WPL 110`, read and written."""
