"""Compares remesh.remesh() with the same calls from C++, in turn.

usage: overhead.py BASELINE MESH... [-n N] [-k ROUNDS]    (BASELINE: remesh_python_baseline)
It judges nothing: other work on the machine changes single figures by more than they differ.
"""

import argparse
import statistics
import subprocess
import time

import files
import remesh

parser = argparse.ArgumentParser()
parser.add_argument("baseline")
parser.add_argument("meshes", nargs="+")
parser.add_argument("-n", type=int, default=2000)
parser.add_argument("-k", "--rounds", type=int, default=9)
arguments = parser.parse_args()

for path in arguments.meshes:
    V, F = files.read_mesh(path)
    rows = []  # C++ by the clock, of all cores, of remesh::remesh() alone; Python.
    with subprocess.Popen([arguments.baseline, path], stdin=subprocess.PIPE, text=True,
                          stdout=subprocess.PIPE) as process:
        for _ in range(arguments.rounds + 1):
            process.stdin.write(f"{arguments.n}\n")
            process.stdin.flush()
            in_cpp = [float(word) for word in process.stdout.readline().split()]
            start, start_of_cores = time.perf_counter(), time.process_time()
            remesh.remesh(V, F, arguments.n)
            rows.append([*in_cpp, time.perf_counter() - start,
                         time.process_time() - start_of_cores])
        process.stdin.close()
    # Without the first round, which warms up.
    cpp, cpp_of_cores, alone, python, python_of_cores = (statistics.median(column)
                                                  for column in zip(*rows[1:]))
    share, share_of_cores = python / cpp - 1, python_of_cores / cpp_of_cores - 1
    # Time of the cores as well: the clock's depends on what else runs.
    print(f"{path}: C++ {cpp:.3f} s, Python {python:.3f} s ({share:+.1%}); time of all cores "
          f"{cpp_of_cores:.3f} s, {python_of_cores:.3f} s ({share_of_cores:+.1%}); medians of "
          f"{arguments.rounds}, n = {arguments.n}; remesh::remesh() alone {alone:.3f} s")
