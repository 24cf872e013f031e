"""`python -m benchmarks`: every benchmark, one after another."""

import sys

from benchmarks import (
    bench_airframes,
    bench_certificates,
    bench_estimator,
    bench_fields,
    bench_mazes,
    bench_physics,
    bench_planner,
    bench_recorder,
    bench_replan,
    bench_rivals,
    bench_search,
    bench_simulate,
    bench_timing,
    bench_tracking,
    bench_vehicle,
)


def main() -> None:
    sys.argv = sys.argv[:1]
    bench_planner.main()
    bench_rivals.main()
    bench_timing.main()
    bench_certificates.main()
    bench_replan.main()
    bench_mazes.main()
    bench_fields.main()
    bench_search.main()
    bench_estimator.main()
    bench_simulate.main()
    bench_physics.main()
    bench_vehicle.main()
    bench_tracking.main()
    bench_airframes.main()
    bench_recorder.main()


if __name__ == "__main__":
    main()
