"""Runs of `suffuse-analyse` in the integration tests, and what they find amiss: all of it is told before a test fails."""
import csv
import subprocess

PROBLEMS = []


def expect(condition, what):
    if not condition:
        PROBLEMS.append(what)
        print(f"FAILED {what}")


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Runner:
    """The program in a folder; `first` words stand before those of each call."""

    def __init__(self, program, folder, *first):
        self.program, self.folder, self.first = program, folder, first

    def __call__(self, *words):
        command = [self.program, *self.first, *map(str, words)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=120)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return name
