"""`companion replay`: the vehicle's recorded traffic to a ground station."""

from pathlib import Path

from companion.cli import show
from companion.cli.operator import Operator
from logs.info import info
from logs.reader import Recording
from logs.replay_driver import Progress, replay
from logs.wire_replay import paced, vehicle_link, vehicle_traffic
from wire.endpoint import Endpoint
from wire.udp import UdpLink


def replay_log(path: Path, to: str, rate: float, as_json: bool) -> int:
    """Replay `path` to `to`; what was sent to the vehicle stays in the file. Returns the exit code."""
    out = show.console()
    endpoint = Endpoint.parse(to)
    recording = Recording.open(path)
    name = vehicle_link(recording)
    about = info(path)
    total = next((link.rx_datagrams for link in about.links if link.name == name), 0)
    operator = Operator()
    with UdpLink("ground", endpoint) as link, operator.listening():
        where = f"{endpoint}" if endpoint.kind == "udpout" else f"whoever calls {endpoint}"
        text = f"replaying {about.duration_s:.1f} s to {where} at rate {rate:g}"
        with show.working(out, text) as status:

            def tell(progress: Progress) -> None:
                if status is not None:
                    status.update(f"{text}: {progress.elapsed_s * rate:6.1f} s, {progress.datagrams} of {total}")

            end = replay(paced(vehicle_traffic(recording, name), rate), link, tell, stop=lambda: operator.asked > 0)
    ok = end.datagrams == total and end.counters.send_errors == 0
    result = {
        "ok": ok,
        "recording": str(path),
        "to": str(endpoint),
        "rate": rate,
        "datagrams": end.datagrams,
        "of": total,
        "duration_s": end.elapsed_s,
        "send_errors": end.counters.send_errors,
        "refused": end.counters.refused,
    }
    if as_json:
        show.print_json(result)
    else:
        nobody = f"; {end.counters.refused} refused: nobody listens there" if end.counters.refused else ""
        out.print(f"{end.datagrams} of {total} datagrams in {end.elapsed_s:.1f} s{nobody}")
    return 0 if ok else 1
