"""--follow: a figure is drawn again whenever the files that it is made of have grown, while the run goes on.

The picture takes its place when it is whole, so that a viewer that looks for changes (most do: eog, gwenview, okular; feh --reload 1)
never sees half of one. No display is needed. Ctrl-C ends it.
"""
import os
import sys
import time


class NoRowsYet(SystemExit):
    """A file that the run has not come to yet: an error, or for who follows a reason to wait."""


def add_option(parser):
    parser.add_argument("--follow", nargs="?", type=float, const=2.0, metavar="SECONDS",
                        help="draw the figure again whenever the series has grown, looked at every so many seconds (2); Ctrl-C ends it")


def state_of(path):
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_size, found.st_mtime_ns, found.st_ino


def draw_once_or_follow(options, inputs, draw):
    """`draw()` reads the inputs and writes the figure: once, or with --follow again and again."""
    if options.follow is None:
        draw()
        return
    if not options.follow > 0:
        sys.exit(f"--follow {options.follow:g}: must be > 0 seconds")
    drawn = None
    try:
        while True:
            now = [state_of(path) for path in inputs]
            if now != drawn:
                try:
                    draw()
                    drawn = now
                except NoRowsYet:
                    pass
            time.sleep(options.follow)
    except KeyboardInterrupt:
        pass
