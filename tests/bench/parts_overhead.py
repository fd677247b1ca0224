#!/usr/bin/env python3
"""parts_overhead.py DEM [PARTS [ROUNDS [MARSVIEW-CLI]]]: what preparing in parts costs.

Prepares DEM once, then in PARTS parts (8), one after the other, in the folder of the script's call:
both rounds and the join. Prints the processor time of each, the largest memory of a process, and
compares the files. Run it on a disk with room for six times the map.
"""
import filecmp
import os
import pathlib
import shutil
import sys
import tempfile

dem = os.path.abspath(sys.argv[1])
parts = int(sys.argv[2]) if len(sys.argv) > 2 else 8
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
build = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "bin"
cli = sys.argv[4] if len(sys.argv) > 4 else str(build / "marsview-cli")


def run(*arguments):
    """Processor seconds and peak memory in MB. A child starts with the peak of its parent, so this
    script must stay small: filecmp reads in pieces."""
    null = os.open(os.devnull, os.O_WRONLY)
    child = os.posix_spawn(cli, [cli, "prepare", dem, *arguments], os.environ,
                           file_actions=[(os.POSIX_SPAWN_DUP2, null, 1)])
    os.close(null)
    _, status, used = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{' '.join(arguments)} failed")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def total(results):
    return sum(seconds for seconds, _ in results)


def peak(results):
    return max(megabytes for _, megabytes in results)


for _ in range(rounds):
    folder = tempfile.mkdtemp(dir=".")
    one, joined = f"{folder}/one.tif", f"{folder}/joined.tif"
    whole = run("-o", one)
    of_parts = ["-o", joined, "--parts", str(parts)]
    copied, measured = ([run(*of_parts, "--part", str(i + 1)) for i in range(parts)]
                        for _ in range(2))
    stored = sum(path.stat().st_size for path in pathlib.Path(joined + ".parts").iterdir())
    join = run(*of_parts, "--join")
    seconds = total(copied) + total(measured) + join[0]
    print(f"one {whole[0]:.2f} s {whole[1]:.0f} MB; {parts} parts: first round {total(copied):.2f} s "
          f"{peak(copied):.0f} MB, second {total(measured):.2f} s {peak(measured):.0f} MB, join "
          f"{join[0]:.2f} s {join[1]:.0f} MB; together {seconds:.2f} s, {seconds / whole[0]:.3f} times one; "
          f"files of the parts {stored / 1e6:.0f} MB, of the map {os.path.getsize(one) / 1e6:.0f} MB; "
          f"{'same bytes' if filecmp.cmp(one, joined, shallow=False) else 'THE FILES DIFFER'}",
          flush=True)
    shutil.rmtree(folder)
