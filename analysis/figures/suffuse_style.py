"""The look that all figures share: sizes, type, colours, and how a figure is written to its file."""
import pathlib
import sys

try:
    import matplotlib
except ImportError:
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: this Python ({sys.executable}) has no matplotlib; "
             "install it (apt-get install python3-matplotlib) or use Debian's Python, /usr/bin/python3")

matplotlib.use("Agg")  # figures go to files; no display is needed
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours, distinguishable with the common kinds of colour blindness and in grey print.
COLOURS = {"blue": "#0072b2", "orange": "#e69f00", "green": "#009e73", "vermilion": "#d55e00",
           "purple": "#cc79a7", "sky": "#56b4e9"}
REFERENCE = {"color": "#606060", "linestyle": (0, (5, 3)), "linewidth": 1.0}  # targets, limits, values from papers

plt.rcParams.update({
    "figure.dpi": 150,
    "figure.constrained_layout.use": True,
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.grid": True,
    "axes.prop_cycle": plt.cycler(color=list(COLOURS.values())),
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "svg.hashsalt": "suffuse",  # the same figure is the same file
    "legend.frameon": False,
})

COLUMN_WIDTH = 5.2  # inches; a figure this wide reads well in a page of text


def plain(text):
    """A user's text as it stands: matplotlib takes what is between two dollars for a formula."""
    return text.replace("$", r"\$")


def width_of(options):
    """Of the figure, inches: what --width says, or the column's. 4.2 reads well on a phone too."""
    return options.width or COLUMN_WIDTH


def stacked_panels(count, panel_height=1.55, width=COLUMN_WIDTH):
    """A figure of `count` panels on one abscissa, and the list of its axes."""
    figure, axes = plt.subplots(count, 1, sharex=True, squeeze=False, figsize=(width, panel_height * count + 0.4))
    return figure, list(axes[:, 0])


def reference_line(axes, value, label):
    """A dashed level across the panel with its name on it, above the line at the right end."""
    axes.axhline(value, **REFERENCE)
    axes.annotate(label, xy=(1, value), xycoords=("axes fraction", "data"), xytext=(-2, 2), textcoords="offset points",
                  ha="right", va="bottom", fontsize=8, color=REFERENCE["color"])


# Tangential forces over the mean normal force f_0, below which no friction is at work: what a sample without friction has are
# rounding and damping.
NOISE = 5e-4


def length_unit(*sizes_m):
    """Factor and name of the unit in which an axis of these sizes is read: mm where the largest has 1 mm or more, as sieves are named, else µm."""
    return (1e3, "mm") if max(sizes_m) >= 1e-3 else (1e6, "µm")


def plain_log_ticks(axis):
    """Numbers as people write them on a logarithmic axis, few enough not to touch each other; call it when all is drawn."""
    import math
    from matplotlib.ticker import LogLocator, NullFormatter

    low, high = sorted(axis.get_view_interval())
    decades = math.log10(high / low)
    subs = (1,) if decades > 4 else (1, 3) if decades > 1.8 else (1, 2, 5) if decades > 0.7 else (1, 1.5, 2, 3, 5, 7)
    axis.set_major_locator(LogLocator(subs=subs, numticks=12))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def save(figure, path):
    """Writes the figure; the format is that of the file's ending. It takes its name when it is whole."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".part_{path.name}")
    try:
        figure.savefig(part, metadata={"Date": None} if path.suffix == ".svg" else None)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
        plt.close(figure)


def shades(count):
    """Colours of layers from the top, distinct in grey and for the colour-blind: a range of lightness without its pale end."""
    return [plt.get_cmap("viridis")(0.9 * k / max(count - 1, 1)) for k in range(count)]
