#!/usr/bin/env python3
"""check_container.py SOURCE_FOLDER: the image of the Containerfile is built by buildah on a bookworm that debootstrap makes, since no registry may be
at hand, and the first scene runs in it. Some twenty minutes; needs root, both tools and Debian's mirror, and skips (77) without them."""
import os
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from commands import run  # noqa: E402

BASE = "localhost/suffuse-bookworm"
IMAGE = "localhost/suffuse-checked"
SCENE = "/usr/share/suffuse/input_scripts/01_isotropic_compression/in.isotropic_compression"
FIGURE = "/usr/share/suffuse/figures/compression.py"
ROWS = re.compile(r"^\s*porosity\b.*", re.MULTILINE)


def mirror():
    """The Debian mirror that apt here takes: debootstrap's own choice where there is none."""
    found = re.search(r"(https?://\S+/debian)\s", shutil.which("apt-cache") and run("apt-cache", "policy") or "")
    return [found[1]] if found else []


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    if os.geteuid() != 0 or not all(shutil.which(tool) for tool in ("buildah", "debootstrap")):
        print("needs root, buildah and debootstrap")
        sys.exit(77)
    # Beside the build: some gigabytes.
    with tempfile.TemporaryDirectory(prefix="container-", dir=os.getcwd()) as name:
        folder = pathlib.Path(name)
        buildah = ["buildah", "--storage-driver", "vfs", "--root", folder / "storage", "--runroot", folder / "run"]
        run("debootstrap", "--variant=minbase", "bookworm", folder / "root", *mirror())
        run("tar", "-C", folder / "root", "-cf", folder / "root.tar", ".")
        base = run(*buildah, "from", "scratch").split()[-1]
        run(*buildah, "add", "--quiet", base, folder / "root.tar", "/")
        run(*buildah, "commit", "--quiet", "--rm", base, BASE)
        shutil.rmtree(folder / "root")
        run("git", "clone", "--quiet", source, folder / "source")
        run(*buildah, "build", "--isolation", "chroot", "--pull-never", "--build-arg", f"BASE={BASE}", "-t", IMAGE, "-f", folder / "source/Containerfile",
            folder / "source")
        image = run(*buildah, "from", "--pull-never", IMAGE).split()[-1]
        said = run(*buildah, "run", "--isolation", "chroot", image, "--", "sh", "-c",
                   f"suffuse-mpirun 2 suffuse -in {SCENE} -var grains 400 && "
                   f"python3 {FIGURE} compression.csv --output compression.png && ls -l compression.png")
        measured = ROWS.search(said)
        if not measured or "compression.png" not in said:
            sys.exit(f"the first scene says in the image:\n{said[-3000:]}")
        print(measured[0])


if __name__ == "__main__":
    main()
