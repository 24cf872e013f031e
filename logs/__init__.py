"""Recordings: one MCAP file a flight, with every datagram, its decoded packets, and our own decisions.

The way in: `logs.recorder.Recorder` writes one at the seam of a core; `Recording.open` reads it, whole or cut short;
`ticks` turns it back into the table of inputs and outputs a re-run needs; `compare` says where two runs part;
`logs.info.info` sums a file up; `logs.wire_replay` paces the vehicle's traffic for a ground station.

`logs.recorder` and `logs.replay_driver` are not imported here: they own a thread, a clock, a socket.

Time: `log_time` and `publish_time` are in [ns], `now_us` in [us], both of the clock the core was given. Frames are
those of the messages recorded; nothing is converted.
"""

from logs.compare import Comparison, Difference, Output, OutputHash, compare, first_difference, outputs_sha256
from logs.container import Attachment, Direction
from logs.errors import LogsError, RecordingError, SchemaVersionError
from logs.reader import ChannelInfo, RecordedMessage, Recording
from logs.table import Entry, RecordedTick, ticks

__all__ = [
    "Attachment",
    "ChannelInfo",
    "Comparison",
    "Difference",
    "Direction",
    "Entry",
    "LogsError",
    "Output",
    "OutputHash",
    "RecordedMessage",
    "RecordedTick",
    "Recording",
    "RecordingError",
    "SchemaVersionError",
    "compare",
    "first_difference",
    "outputs_sha256",
    "ticks",
]
