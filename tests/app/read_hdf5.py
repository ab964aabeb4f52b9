"""Prints the contents of a file as JSON, read by h5py: groups and datasets with attributes."""

import json
import sys

import h5py
import numpy


def without_nan(values):
    """Nested lists with None for NaN, which JSON does not have."""
    if isinstance(values, list):
        return [without_nan(value) for value in values]
    return None if values != values else values


def plain(value):
    return value.tolist() if isinstance(value, (numpy.ndarray, numpy.generic)) else value


def tree(node):
    found = {name: plain(value) for name, value in node.attrs.items()}
    if isinstance(node, h5py.Dataset):
        return {**found, "values": without_nan(node[()].tolist())}
    return {**found, **{name: tree(child) for name, child in node.items()}}


with h5py.File(sys.argv[1]) as file:
    json.dump(tree(file), sys.stdout, allow_nan=False)
