"""Commands whose failure is the test's."""
import subprocess
import sys


def run(*command, **options):
    """What a command prints; the test ends with the last of it where the command fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: code {done.returncode}\n{done.stdout[-3000:]}")
    return done.stdout
