#!/usr/bin/env python3
"""consumer_test.py BUILD_FOLDER SOURCE_FOLDER COMPILER [LIGGGHTS_EXAMPLE]: another project finds Suffuse in an installed prefix, builds
against its libraries and headers and computes with them; and configures with the sources as its subproject."""
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from commands import run  # noqa: E402


def main():
    build, source, compiler = sys.argv[1:4]
    example = sys.argv[4] if len(sys.argv) > 4 else None
    project = pathlib.Path(__file__).with_name("consumer")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = folder / "prefix"
        run("cmake", "--install", build, "--prefix", prefix)
        words = [f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={compiler}", "-G", "Ninja"]
        if example:
            words.append(f"-DWITH_LIGGGHTS={example}")
        run("cmake", "-S", project, "-B", folder / "build", *words)
        made = (folder / "build/build.ninja").read_text()
        if re.search(rf"(-I|-isystem ){re.escape(source)}|{re.escape(build)}", made):
            sys.exit("the installed package refers to its sources")
        run("cmake", "--build", folder / "build")
        answer = run(folder / "build/channel")
        if "Terzaghi 0.9900" not in answer:  # (2650/1000 - 1)(1 - 0.4)
            sys.exit(f"the consumer answers: {answer}")
        print(answer.strip())
        if example:
            print(run(folder / "build/falling_grains").strip().splitlines()[-1])
        run("cmake", "-S", project, "-B", folder / "sub", f"-DSUFFUSE_SOURCE={source}", *words[1:2], "-G", "Ninja")
        if (folder / "sub/suffuse/tests").exists():
            sys.exit("a subproject builds the tests")


if __name__ == "__main__":
    main()
