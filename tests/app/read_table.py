"""Prints the table of a sweep as JSON, read by pandas and by h5py."""

import json
import sys

import h5py
import pandas

folder = sys.argv[1]
table = pandas.read_csv(f"{folder}/table.csv")
rows = json.loads(table.to_json(orient="records", double_precision=15))


def plain(dataset):
    values = dataset.asstr()[...] if h5py.check_string_dtype(dataset.dtype) else dataset[...]
    return values.tolist()


with h5py.File(f"{folder}/table.h5") as file:
    datasets = {}
    file.visititems(
        lambda name, item: datasets.update({name: plain(item)})
        if isinstance(item, h5py.Dataset)
        else None
    )
print(json.dumps({"rows": rows, "datasets": datasets}))
