"""The plug-in, where the package is not installed: pytest finds it by its entry point where it is."""

import pytest

from companion.testing import plugin


def pytest_configure(config: pytest.Config) -> None:
    if not config.pluginmanager.is_registered(plugin):
        config.pluginmanager.register(plugin, "companion")
