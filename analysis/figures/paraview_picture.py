"""paraview_picture.py FILE.xdmf --output PICTURE.png [--time SECONDS]: by pvbatch (without a display: xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvbatch ...), the picture of a run with water.

The water in a vertical slice coloured by speed, the grains behind it as spheres, and the force chains as tubes where `lbm output ... contacts` has
left them: FILE_grains.xdmf and FILE_contacts.xdmf beside FILE.xdmf. The last state, or the one nearest to --time."""
import argparse
import pathlib

from paraview import simple


def reader_of(path, time):
    """The file's reader at the state nearest to a time (the last without), or None where there is no file."""
    if not path.exists():
        return None, time
    reader = simple.XDMFReader(FileNames=[str(path)])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues) or [0.0]
    at = times[-1] if time is None else min(times, key=lambda t: abs(t - time))
    reader.UpdatePipeline(at)
    return reader, at


def show_water(view, water, across):
    half = simple.Slice(Input=water, SliceType="Plane")
    half.SliceType.Origin, half.SliceType.Normal = across, [0, 1, 0]
    if "solid_fraction" in water.CellData.keys():  # grains show where they are cut
        half = simple.Threshold(Input=half, Scalars=["CELLS", "solid_fraction"], ThresholdMethod="Below Lower Threshold", LowerThreshold=0.5)
    speed = simple.Calculator(Input=half, AttributeType="Cell Data", ResultArrayName="speed (m/s)", Function="mag(velocity)")
    speed.UpdatePipeline(view.ViewTime)
    shown = simple.Show(speed, view)
    simple.ColorBy(shown, ("CELLS", "speed (m/s)"))
    colours = simple.GetColorTransferFunction("speed (m/s)")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(0, speed.CellData["speed (m/s)"].GetRange(0)[1])
    shown.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.ComponentTitle = ""


def show_grains(view, grains, across, opacity):
    """Their halves in front of the slice are cut away, so that it is seen between them."""
    spheres = simple.Glyph(Input=grains, GlyphType="Sphere", GlyphMode="All Points")
    spheres.ScaleArray, spheres.ScaleFactor, spheres.OrientationArray = ["POINTS", "diameter"], 1.0, ["POINTS", "No orientation array"]
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 24
    behind = simple.Clip(Input=spheres, ClipType="Plane", Invert=1)
    behind.ClipType.Origin, behind.ClipType.Normal = [across[0], across[1] + 1e-6, across[2]], [0, -1, 0]
    behind.UpdatePipeline(view.ViewTime)
    shown = simple.Show(behind, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.85, 0.8, 0.7]
    shown.Opacity = opacity


def show_contacts(view, contacts, thickest):
    """Tubes whose radius is the normal force's share of the largest; none where no grains touch."""
    forces = simple.CellDatatoPointData(Input=simple.ExtractSurface(Input=contacts))
    forces.UpdatePipeline(view.ViewTime)
    largest = max(abs(end) for end in forces.PointData["normal_force"].GetRange(0))
    if largest == 0:
        return
    radii = simple.Calculator(Input=forces, AttributeType="Point Data", ResultArrayName="radius", Function=f"{thickest / largest}*abs(normal_force)")
    radii.UpdatePipeline(view.ViewTime)
    chains = simple.Tube(Input=radii)
    chains.Scalars, chains.Vectors, chains.VaryRadius = ["POINTS", "radius"], ["POINTS", "force"], "By Absolute Scalar"
    shown = simple.Show(chains, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.8, 0.2, 0.1]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fields", type=pathlib.Path)
    parser.add_argument("--output", required=True)
    parser.add_argument("--time", type=float)
    options = parser.parse_args()
    water, time = reader_of(options.fields, options.time)
    if water is None:
        parser.error(f"{options.fields} is not there; give FILE.xdmf of `lbm output`")
    beside = options.fields.with_name
    grains, _ = reader_of(beside(options.fields.stem + "_grains.xdmf"), time)
    contacts, _ = reader_of(beside(options.fields.stem + "_contacts.xdmf"), time)
    low = water.GetDataInformation().GetBounds()[0::2]
    high = water.GetDataInformation().GetBounds()[1::2]
    across = [(a + b) / 2 for a, b in zip(low, high)]
    size = max(b - a for a, b in zip(low, high))
    view = simple.CreateRenderView(ViewSize=[900, 1200], Background=[1, 1, 1], UseColorPaletteForBackground=0)
    view.ViewTime = time
    view.OrientationAxesVisibility = 0
    show_water(view, water, across)
    if grains is not None:
        show_grains(view, grains, across, 0.35 if contacts is not None else 1)
    if contacts is not None:
        show_contacts(view, contacts, size / 150)
    view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = across, [across[0] + 0.6 * size, across[1] - 2 * size, across[2] + 0.4 * size], [0, 0, 1]
    simple.ResetCamera(view)
    simple.SaveScreenshot(options.output, view)


if __name__ == "__main__":
    main()
