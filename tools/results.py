# SPDX-License-Identifier: MIT
"""Files of results in out/, with one or more rows for each board."""
import csv
import os


def read(path):
    """The rows of a file by column; none if there is no such file."""
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write(path, columns, rows, measured=None):
    """Write rows in the order of columns, sorted by the first one, the board. If only some boards were measured, the rows of
    the others stay."""
    kept = [] if measured is None else \
        [list(row.values()) for row in read(path) if row["board"] not in measured]
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns.split(","))
        writer.writerows(sorted(kept + rows, key=lambda row: row[0]))
