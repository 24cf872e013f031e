"""What can go wrong in a campaign for the caller.

CampaignError
├── CampaignInterrupted  Ctrl-C, or a signal to end; what was done is kept
└── SchedulerError  no Dask scheduler or worker that could be used, or none any more
    └── AddressError  where it is was not said as tcp://HOST:PORT

A flight that fails is no error but a result, and so is work that cannot be done (`campaigns.executors.base.Outcome`).
"""


class CampaignError(Exception):
    """Root of everything campaigns raise; its text is one line for a person."""


class CampaignInterrupted(CampaignError):
    """Somebody ended it before its end."""


class SchedulerError(CampaignError):
    """A Dask scheduler or its workers cannot be used.

    Attributes
    ----------
    address : as it was given.
    """

    def __init__(self, address: str, problem: str) -> None:
        self.address = address
        super().__init__(f"{address}: {problem}")


class AddressError(SchedulerError):
    """What was given for a scheduler's address is none."""
