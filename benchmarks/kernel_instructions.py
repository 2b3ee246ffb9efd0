"""What the loop of each collide-and-stream kernel consists of, counted in the disassembly of a program.

    python3 benchmarks/kernel_instructions.py build/release/bin/lbm_step_benchmark [PATTERN]

One line a kernel whose name matches PATTERN (default: those without solids): instructions of the loop over packs,
of which vector arithmetic, divisions and roots, stores of populations, spills to the stack and vector operands
read from it, prefetches. A pack is 64 bytes of cells with AVX-512, 32 with AVX2: 8 or 4 double, 16 or 8 float.
"""

import re
import subprocess
import sys


def loops(program):
    """Name and loop body (a list of instructions) of each kernel: the longest backward jump and what it spans."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-C", program], capture_output=True, text=True,
                          check=True).stdout
    for block in text.split("\n\n"):
        name, _, body = block.partition(":\n")
        if "step_row<" not in name:
            continue
        code = [(int(a, 16), i.strip()) for a, i in re.findall(r"^ +([0-9a-f]+):\t(.*)$", body, re.M)]
        jumps = [(int(m[1], 16), a) for a, i in code if (m := re.match(r"j\w+\s+([0-9a-f]+)", i))]
        jumps = [(to, at) for to, at in jumps if code[0][0] <= to < at]
        if jumps:
            begin, end = max(jumps, key=lambda j: j[1] - j[0])
            yield re.sub(r"^.*<void |suffuse::lbm::|\(.*$", "", name), [i for a, i in code if begin <= a <= end]


def count(body):
    vector = [i for i in body if i.startswith("v")]
    stack = [i for i in vector if "(%rsp" in i or "(%rbp" in i]
    stores = [i for i in vector if i.startswith("vmov") and i.split("#")[0].rstrip().endswith(")")]
    spills = [i for i in stores if i in stack]
    return {"all": len(body),
            "arithmetic": sum(bool(re.match(r"v(add|sub|mul|fm|fnm)", i)) for i in vector),
            "division": sum(bool(re.match(r"v(div|sqrt)", i)) for i in vector),
            "stores": len(stores) - len(spills),
            "spills": len(spills),
            "from stack": len(stack) - len(spills),
            "prefetch": sum(i.startswith("prefetch") for i in body)}


def main():
    pattern = sys.argv[2] if len(sys.argv) > 2 else r"avx.*NoSolid"
    found = [(name, body) for name, body in sorted(loops(sys.argv[1])) if re.search(pattern, name)]
    if not found:
        sys.exit(f"{sys.argv[1]} has no kernel whose name matches {pattern}")
    for name, body in found:
        print(f"{name:84s}" + "  ".join(f"{key} {value}" for key, value in count(body).items()))


if __name__ == "__main__":
    main()
