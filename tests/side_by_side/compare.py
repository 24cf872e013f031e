"""Prints how our vehicle answers each recorded client beside how the real autopilot did.

python tests/side_by_side/compare.py            the differences, each with its reason
python tests/side_by_side/compare.py --all      every turn
"""

import sys

from test_side_by_side import CIRCLE, MAVPROXY, PX4, SERVICES, differences, fits, reasons, same, talks


def main() -> int:
    """The number of differences without a reason."""
    unexplained = 0
    for recording in (PX4, SERVICES, CIRCLE, MAVPROXY):
        theirs, ours = talks(recording)
        alike = sum(same(real, here) for real, here in zip(theirs.turns, ours.turns, strict=True))
        print(f"\n{recording}: {len(theirs.turns)} turns, {alike} answered alike")
        if "--all" in sys.argv:
            for real, here in zip(theirs.turns, ours.turns, strict=True):
                mark, at_s = " " if same(real, here) else "!", real.at_us * 1e-6
                print(f"{mark} {at_s:8.3f} {real.said:44} | {' '.join(real.answers)} | {' '.join(here.answers)}")
        table = reasons(recording.name)
        for found in differences(theirs, ours):
            why = next((reason for row, reason in table.items() if fits(found, row)), "NO REASON")
            unexplained += why == "NO REASON"
            said, real_answers, our_answers = found
            print(f"! {said}\n      theirs {real_answers or '-'}\n      ours   {our_answers or '-'}\n      {why}")
    return unexplained


if __name__ == "__main__":
    sys.exit(main())
