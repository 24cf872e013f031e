"""The same work for many items, somewhere else: results as they come, whatever happens to who does it.

with closing(local(jobs=2)) as executor:
    for outcome in executor.map(fly_run, runs, timeout_s=600, retries=2):
        ...

Work is a function at the top of a module that depends on its item only; items and results can be pickled.
"""

from campaigns.executors.base import Executor, Outcome
from campaigns.executors.local import local

__all__ = ["Executor", "Outcome", "local"]
