"""Errors of `wire`.

    WireError
    ├── EndpointError    an endpoint's text cannot be understood
    └── LinkError        the operating system refuses a socket

Nothing a peer sends raises: it becomes a counter.
"""


class WireError(Exception):
    """Root of every error raised by `wire`."""


class EndpointError(WireError):
    """The text of an endpoint is not one.

    Attributes
    ----------
    text : the whole text given.
    found : the part that is wrong.
    expected : what should stand there.
    """

    def __init__(self, text: str, found: str, expected: str) -> None:
        super().__init__(f"endpoint {text!r}: found {found!r}, expected {expected}")
        self.text = text
        self.found = found
        self.expected = expected


class LinkError(WireError):
    """A socket could not be opened; the message is one line that says which endpoint and why.

    Attributes
    ----------
    link : name the driver gave the link.
    endpoint : the endpoint, in pymavlink's spelling.
    reason : what went wrong, in words.
    """

    def __init__(self, link: str, endpoint: str, reason: str) -> None:
        super().__init__(f"link {link!r} ({endpoint}): {reason}")
        self.link = link
        self.endpoint = endpoint
        self.reason = reason
