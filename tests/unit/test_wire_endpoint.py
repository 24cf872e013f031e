"""Endpoint texts, as pymavlink, MAVProxy and MAVSDK users write them."""

import pytest

from wire import Endpoint, EndpointError


@pytest.mark.parametrize(
    ("text", "kind", "host", "port"),
    [
        ("udpin:127.0.0.1:14540", "udpin", "127.0.0.1", 14540),
        ("udpin://127.0.0.1:14540", "udpin", "127.0.0.1", 14540),
        ("udpout:10.0.0.7:14550", "udpout", "10.0.0.7", 14550),
        ("udpout://[::1]:14550", "udpout", "::1", 14550),
        ("udpin:[::]:14550", "udpin", "::", 14550),
        ("udpin:0.0.0.0:14540", "udpin", "0.0.0.0", 14540),
        ("udpout:vehicle.local:14580", "udpout", "vehicle.local", 14580),
    ],
)
def test_both_spellings_are_read(text: str, kind: str, host: str, port: int) -> None:
    endpoint = Endpoint.parse(text)
    assert (endpoint.kind, endpoint.host, endpoint.port) == (kind, host, port)


def test_udp_means_udpin_as_it_does_to_pymavlink() -> None:
    assert Endpoint.parse("udp:127.0.0.1:14550") == Endpoint.parse("udpin:127.0.0.1:14550")


@pytest.mark.parametrize("text", ["udpin::14540", "udpin://:14540", "udpin:14540"])
def test_no_host_means_loopback_and_never_every_interface(text: str) -> None:
    assert Endpoint.parse(text).host == "127.0.0.1"


def test_port_zero_asks_for_any_free_port_but_nobody_can_be_called_there() -> None:
    assert Endpoint.parse("udpin:127.0.0.1:0").port == 0
    with pytest.raises(EndpointError, match="found '0', expected a port from 1 to 65535"):
        Endpoint.parse("udpout:127.0.0.1:0")


@pytest.mark.parametrize("text", ["udpin:127.0.0.1:14540", "udpout:[::1]:14550", "udpin:localhost:0"])
def test_the_text_of_an_endpoint_gives_back_the_endpoint(text: str) -> None:
    assert str(Endpoint.parse(text)) == text


@pytest.mark.parametrize(
    ("text", "found", "expected"),
    [
        ("tcp:127.0.0.1:5760", "tcp", "udpin"),
        ("/dev/ttyACM0", "/dev/ttyACM0", "udpin"),
        ("", "", "udpin"),
        ("udpin", "udpin", "HOST:PORT"),
        ("udpin:127.0.0.1", "127.0.0.1", "a port"),
        ("udpin:127.0.0.1:", "", "a port"),
        ("udpin:127.0.0.1:99999", "99999", "0 to 65535"),
        ("udpin:127.0.0.1:-1", "-1", "0 to 65535"),
        ("udpin:127.0.0.1:٣", "٣", "0 to 65535"),
        ("udpin:::1:14540", "::1:14540", "in brackets"),
        ("udpin:[::1:14540", "[::1:14540", "[IPv6 ADDRESS]:PORT"),
        ("udpin://udpin://h:1", "udpin://h:1", "in brackets"),
        ("udpin:a b:14540", "a b", "a host name"),
    ],
)
def test_an_error_names_the_text_what_was_found_and_what_was_expected(text: str, found: str, expected: str) -> None:
    with pytest.raises(EndpointError) as caught:
        Endpoint.parse(text)
    error = caught.value
    assert error.text == text
    assert error.found == found
    assert expected in error.expected
    assert repr(text) in str(error)
    assert repr(found) in str(error)
    assert "\n" not in str(error)


def test_an_endpoint_built_wrongly_in_code_is_a_value_error() -> None:
    with pytest.raises(ValueError, match="port"):
        Endpoint("udpin", "127.0.0.1", 70_000)
    with pytest.raises(ValueError, match="host"):
        Endpoint("udpin", "", 14540)
    with pytest.raises(ValueError, match="kind"):
        Endpoint("tcp", "127.0.0.1", 14540)  # type: ignore[arg-type]
