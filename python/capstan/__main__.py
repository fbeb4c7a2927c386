# SPDX-License-Identifier: BSD-3-Clause
"""``python -m capstan`` is the command ``capstan``: the program that came with the package takes over the process."""
import os
import sys
from typing import NoReturn

from . import _netcdf


def main() -> NoReturn:
    command = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "capstan")
    if not os.path.exists(command):
        sys.exit(f"capstan: {command} is missing: the package was not installed completely")
    _netcdf.for_a_command()
    sys.stdout.flush()
    sys.stderr.flush()
    os.execv(command, ["capstan"] + sys.argv[1:])


if __name__ == "__main__":
    main()
