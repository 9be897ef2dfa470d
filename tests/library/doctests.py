"""Runs the examples in the package's documentation, in a folder that has a small scene."""
import doctest
import importlib
import pkgutil
import sys
from pathlib import Path

import numpy as np

import weft

SCENE = 'return { frames = 4, camera = { from = {0, 0, 5}, at = {0, 0, 0} }, world = sphere { radius = 1 } }\n'


def main():
    Path("scene.lua").write_text(Path(sys.argv[1]).read_text() if len(sys.argv) > 1 else SCENE)
    tried = failed = 0
    for found in [None, *pkgutil.iter_modules(weft.__path__)]:
        module = weft if found is None else importlib.import_module("weft." + found.name)
        result = doctest.testmod(module, globs={"weft": weft, "np": np},
                                 optionflags=doctest.ELLIPSIS)
        tried, failed = tried + result.attempted, failed + result.failed
    print(f"{tried} examples, {failed} failed")
    return int(failed or not tried)


sys.exit(main())
