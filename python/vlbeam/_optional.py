"""Packages that only some things need."""

import importlib


def needs(package, extra):
    """Imports an optional package, or says how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"this needs {package.partition('.')[0]}: pip install 'vlbeam[{extra}]', or Debian's "
                          f"python3-{package.partition('.')[0]} ({error})") from None
