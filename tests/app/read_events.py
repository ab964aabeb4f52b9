"""Prints an event log in HDF5 as CSV without units, read by h5py: a column for each component."""

import sys

import h5py

with h5py.File(sys.argv[1]) as file:
    columns = {}
    for name, dataset in file.items():
        assert dataset.attrs["units"]
        values = dataset[()]
        if values.ndim == 1:
            columns[name] = values
        else:
            for k in range(values.shape[1]):
                columns[name + "_" + "xyz"[k]] = values[:, k]
    header = sys.argv[2].split(",")
    assert sorted(columns) == sorted(header), (sorted(columns), sorted(header))
    for row in zip(*(columns[name] for name in header)):
        print(",".join(repr(value.item()) for value in row))
