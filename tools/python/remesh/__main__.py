"""`python -m remesh IN OUT ...` is the program `remesh`: see docs/cli.md."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program of the package or, if it has none, the one on the PATH."""
    package = Path(__file__).resolve().parent
    own = package / "bin" / "remesh"
    program = str(own) if own.exists() else shutil.which("remesh")
    if program is None:
        sys.exit("python -m remesh: there is no program remesh; install the package by pip, or "
                 "put the folder of the program into PATH")
    environment = dict(os.environ)
    if own.exists():
        folders = [str(package), environment.get("LD_LIBRARY_PATH", "")]
        environment["LD_LIBRARY_PATH"] = os.pathsep.join(filter(None, folders))
    os.execve(program, ["remesh", *sys.argv[1:]], environment)


if __name__ == "__main__":
    main()
