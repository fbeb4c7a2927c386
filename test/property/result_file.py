# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a result.nc, by nothing but the layout of classic netCDF files (versions 1 and 2)."""
import array
import struct
import sys

DIMENSION, VARIABLE, ATTRIBUTE = 10, 11, 12
SIZE = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}
CODE = {1: "b", 2: "b", 3: "h", 4: "i", 5: "f", 6: "d"}


def numbers(data, at, kind, count):
    out = array.array(CODE[kind])
    out.frombytes(data[at:at + SIZE[kind]*count])
    if sys.byteorder == "little":
        out.byteswap()
    return out


class Header:
    def __init__(self, data):
        self.data, self.at = data, 4

    def number(self, code=">i"):
        value, = struct.unpack_from(code, self.data, self.at)
        self.at += struct.calcsize(code)
        return value

    def name(self):
        size = self.number()
        text = self.data[self.at:self.at + size].decode()
        self.at += (size + 3)//4*4
        return text

    def tagged(self, tag, item):
        """a list of items behind its tag; absent: two zeros"""
        found, count = self.number(), self.number()
        assert found == tag or (found == 0 and count == 0), "not a classic netCDF file"
        return [item() for _ in range(count)]

    def attribute(self):
        name, kind, count = self.name(), self.number(), self.number()
        size = SIZE[kind]*count
        value = self.data[self.at:self.at + size].decode() if kind == 2 else numbers(self.data, self.at, kind, count)
        self.at += (size + 3)//4*4
        return name, value


class Results:
    """steps; get(name, step): the numbers of a variable, flat, of one step where it has steps."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        assert data[:3] == b"CDF" and data[3] in (1, 2), "not a classic netCDF file"
        header = Header(data)
        self.data, self.steps = data, header.number()
        dimensions = header.tagged(DIMENSION, lambda: (header.name(), header.number()))
        self.attributes = dict(header.tagged(ATTRIBUTE, header.attribute))
        offset = ">i" if data[3] == 1 else ">q"
        self.attributes_of = {}

        def variable():
            name = header.name()
            shape = [dimensions[header.number()][1] for _ in range(header.number())]
            self.attributes_of[name] = dict(header.tagged(ATTRIBUTE, header.attribute))
            kind, size, begin = header.number(), header.number(), header.number(offset)
            return name, (shape, kind, size, begin)
        self.variables = dict(header.tagged(VARIABLE, variable))
        # records of all variables with steps lie one after the other
        self.record = sum(size for shape, kind, size, begin in self.variables.values() if shape and shape[0] == 0)

    def get(self, name, step=0):
        shape, kind, _, begin = self.variables[name]
        stepped = bool(shape) and shape[0] == 0
        count = 1
        for extent in shape[1:] if stepped else shape:
            count *= extent
        return numbers(self.data, begin + (step*self.record if stepped else 0), kind, count)
