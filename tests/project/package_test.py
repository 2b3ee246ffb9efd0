#!/usr/bin/env python3
"""package_test.py BUILD_FOLDER VERSION CPACK: the Debian packages have what they should, need what is in bookworm, install under a
root of their own, and the program runs from there."""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from commands import run  # noqa: E402

HELD = {"suffuse": ["./usr/bin/suffuse", "./usr/bin/suffuse-analyse", "./usr/bin/suffuse-study", "./usr/bin/suffuse-flow", "./usr/bin/suffuse-mpirun",
                    "./usr/share/suffuse/input_scripts/01_isotropic_compression/in.isotropic_compression", "./usr/share/suffuse/figures/fluidisation.py",
                    "./usr/share/man/man1/suffuse.1"],
        "suffuse-dev": ["./usr/include/suffuse-0.1/suffuse/lbm/fluid.h", "./usr/include/suffuse-0.1/register_styles.h"]}
NEEDED = {"suffuse": ["libliggghts3", "libopenmpi3", "libhdf5-openmpi-103", "openmpi-bin"], "suffuse-dev": ["libliggghts-dev", "libeigen3-dev"]}
SCENE = "units si\natom_style granular\nboundary f f f\nnewton off\nregion b block 0 1 0 1 0 1 units box\ncreate_box 1 b\nlbm fluid density 1000\n"


def main():
    build, version, cpack = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(cpack, "--config", pathlib.Path(build).resolve() / "CPackConfig.cmake", "-B", folder, cwd=folder)
        for package, held in HELD.items():
            (file,) = folder.glob(f"{package}_{version}_*.deb")
            contents = run("dpkg-deb", "--contents", file)
            missing = [path for path in held if path + "\n" not in contents + "\n"]
            needs = run("dpkg-deb", "--field", file, "Depends")
            missing += [needed for needed in NEEDED[package] if needed not in needs]
            if missing:
                sys.exit(f"{file.name}: without {missing}; needs {needs}")
            print(file.name, f"{file.stat().st_size / 1e6:.1f} MB; {needs.strip()}")
            root = folder / "root"
            (root / "var/lib/dpkg/info").mkdir(parents=True, exist_ok=True)
            (root / "var/lib/dpkg/status").touch()
            run("dpkg", f"--root={root}", f"--log={folder / 'dpkg.log'}", "--force-depends", "--force-not-root", "--force-script-chrootless", "--install", file)
        scene = folder / "in.scene"
        scene.write_text(SCENE)
        run(root / "usr/bin/suffuse", "-in", scene, "-log", "none", cwd=folder)
        states = run("dpkg-query", f"--admindir={root}/var/lib/dpkg", "-W", "-f", "${Package} ${db:Status-Status}\n")
        if "suffuse installed" not in states:
            sys.exit(f"dpkg says: {states}")


if __name__ == "__main__":
    main()
