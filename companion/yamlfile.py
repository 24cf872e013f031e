"""YAML that people write, by one set of rules: missions, files of several vehicles, the service's configuration.

PyYAML's safe loader, and beyond that refused: aliases, which a few bytes can make endless; bottomless nesting; two
equal keys in one mapping, of which YAML silently keeps the last; a document that is no mapping.
"""

from collections.abc import Callable
from typing import Any

import yaml

from companion.errors import CompanionError

MAX_DEPTH = 32
"""Of nested lists and mappings; a mission needs seven."""
Failed = Callable[[str, list[str]], CompanionError]
"""Makes the error of a file and its problems."""


def read_yaml(
    data: bytes, file: str, failed: Failed, *, most_bytes: int, expected: str
) -> tuple[dict[Any, Any], yaml.MappingNode]:
    """The mapping in a file, and its nodes, which know their lines.

    Parameters
    ----------
    file : its name in errors.
    failed : `MissionError` or `ConfigError`.
    expected : what the file is, as errors say it.

    Raises
    ------
    What `failed` makes: the file is too large, not YAML, or one of the traps above.
    """
    if len(data) > most_bytes:
        raise failed(file, [f"found more than {most_bytes} bytes, expected a file that people write"])
    try:
        text = data.decode("utf-8")
        trap = _trap(text)
        if trap:
            raise failed(file, [trap])
        loader = yaml.SafeLoader(text)
        node = loader.get_single_node()
        twice = _repeated_keys(node)
        if twice:
            raise failed(file, twice)
        document = None if node is None else loader.construct_document(node)
    except UnicodeDecodeError as error:
        raise failed(file, [f"byte {error.start}: not UTF-8 text"]) from error
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise failed(file, [f"line {line}: not YAML: {error.problem or error.context}"]) from error
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise failed(file, [f"not YAML: {' '.join(str(error).split())[:120]}"]) from error
    if not isinstance(document, dict) or not isinstance(node, yaml.MappingNode):
        raise failed(file, [f"line 1: found {shown(document)}, expected {expected}"])
    return document, node


def line_of(node: yaml.Node | None, keys: list[Any]) -> int:
    """Line where the deepest node that the key path reaches is named."""
    line = 1
    for key in keys:
        if isinstance(node, yaml.MappingNode):
            found = next(((k, v) for k, v in node.value if k.value == str(key)), None)
            if found is None:
                break
            line, node = found[0].start_mark.line + 1, found[1]
        elif isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
            node = node.value[key]
            line = node.start_mark.line + 1
        else:
            break
    return line


def shown(value: Any) -> str:
    """What was found, for people."""
    if isinstance(value, dict):
        return "a mapping with " + (", ".join(map(str, list(value)[:6])) or "no keys")
    if isinstance(value, list):
        return f"a list of {len(value)}"
    return "nothing" if value is None else repr(value)[:60]


def _trap(text: str) -> str:
    """What is YAML and yet nothing that people write, or nothing."""
    depth = 0
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        line = event.start_mark.line + 1 if event.start_mark is not None else 1
        if isinstance(event, yaml.AliasEvent):
            return f"line {line}: found a YAML alias (*name), expected every value written out"
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > MAX_DEPTH:
            return f"line {line}: found more than {MAX_DEPTH} levels of nesting"
    return ""


def _repeated_keys(root: yaml.Node | None) -> list[str]:
    """A line for each key that is there twice."""
    problems, waiting = [], [] if root is None else [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, yaml.MappingNode):
            seen: set[str] = set()
            for key, value in node.value:
                if str(key.value) in seen:
                    problems.append(f"line {key.start_mark.line + 1}: {key.value}: found twice, expected once")
                seen.add(str(key.value))
                waiting.append(value)
        elif isinstance(node, yaml.SequenceNode):
            waiting.extend(node.value)
    return problems
