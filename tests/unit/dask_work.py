"""Work that a worker imports in no time."""

import os
import signal
import time


def square(number: int) -> int:
    return number * number


def squares_slowly(number: int) -> int:
    time.sleep(0.1)
    return number * number


def raises_hangs_or_dies(number: int) -> int:
    if number == 1:
        raise ValueError("one is not to be")
    if number == 2:
        time.sleep(600.0)
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return number
