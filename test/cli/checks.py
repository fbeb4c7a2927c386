# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command share: the faults found, what is expected, and files as bytes."""
faults = []


def expect(what, holds, found=""):
    if not holds:
        faults.append(f"{what}: {found!r}")


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def read(name):
    with open(name, "rb") as file:
        return file.read()
