"""Reads the time series that runs leave: CSV, one header row of names with units, SI, lines that start with # left out.

An empty cell, a number that is not defined there, is read as NaN.
"""
import csv
import math
import sys

from follow import NoRowsYet


class TimeSeries:
    """Columns by name, each a list of numbers as long as the series. `growing`: a last line without its end is left out."""

    def __init__(self, path, growing=False):
        self.path = path
        try:
            with open(path, newline="", encoding="utf-8") as file:
                lines = [line for line in file if not line.startswith("#") and (line.endswith("\n") or not growing)]
        except FileNotFoundError as problem:
            raise NoRowsYet(f"{path}: {problem.strerror}; give the CSV file that the run wrote")
        except OSError as problem:
            sys.exit(f"{path}: {problem.strerror}; give the CSV file that the run wrote")
        rows = [row for row in csv.reader(lines) if row]
        if len(rows) < 2:
            raise NoRowsYet(f"{path}: has no rows under its header; has the run got that far?")
        header = [name.strip() for name in rows[0]]
        self.columns = {name: [] for name in header}
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(header):
                sys.exit(f"{path}: row {number} has {len(row)} values, the header {len(header)} names; is the run still writing (--follow)?")
            for name, text in zip(header, row):
                try:
                    value = float(text) if text.strip() else math.nan
                except ValueError:
                    sys.exit(f"{path}: row {number}, {name}: '{text}' is no number")
                self.columns[name].append(value)

    def require(self, *names):
        missing = [name for name in names if name not in self.columns]
        if missing:
            sys.exit(f"{self.path}: has no column {', '.join(missing)}; it has {', '.join(self.columns)}")

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        return self.columns[name]

    def last(self, name):
        return self.columns[name][-1] if name in self.columns else math.nan


def numbered(series, prefix):
    """The columns prefix1, prefix2, ... as far as they go."""
    found = []
    while f"{prefix}{len(found) + 1}" in series:
        found.append(series[f"{prefix}{len(found) + 1}"])
    return found
