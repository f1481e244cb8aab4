#!/usr/bin/env python3
"""check.py WINDOWS LINUX DATA MESHES WORK: runs the programs in the folder WINDOWS under wine, and holds what they write
against what those in LINUX write, which were built with the same options. MESHES may be missing. Prints times, too."""
import os
import pathlib
import shutil
import subprocess
import sys
import time

windows, linux, data, meshes, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
FORMATS = ["ply", "obj", "off", "stl", "vtp", "glb", "ply.gz", "mesh", "3mf", "vtk"]
# Spaces, letters in and beyond the code page of Western Windows, one that UTF-16 writes in two parts.
FOLDER = "a folder/größe 網 𝛼"


def command(folder, program):
    return ["wine", str(folder / f"{program}.exe")] if folder == windows else [str(folder / program)]


def run(folder, program, *arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options):
    return subprocess.run([*command(folder, program), *map(str, arguments)], cwd=work, stdout=stdout, stderr=stderr, timeout=900, **options)


def check(have, wanted, text):
    if have != wanted:
        sys.exit(f"tests/windows/check.py: {text}: {str(have)[:1000]} in place of {str(wanted)[:1000]}")


def here(file):
    return os.path.relpath(file, work)


def content(name):
    path = work / name
    return path.read_bytes() if path.exists() else None


def compare(program, *arguments, output=None, **options):
    """Both say the same, with the same exit code, and write the same bytes. Returns these, or None."""
    results = []
    for folder in windows, linux:
        if output:
            (work / output).unlink(missing_ok=True)
        done = run(folder, program, *arguments, **options)
        results.append((done.returncode, done.stderr.decode(), done.stdout, output and content(output)))
    check(*results, f"{program} {arguments}")
    return results[0][3] if output else results[0][2]


def check_meshes():
    files = sorted(file for folder in (data, meshes, meshes / "dirty") if folder.exists()
                   for file in folder.iterdir() if file.suffix in (".ply", ".obj", ".off", ".stl"))
    if not meshes.exists():
        print(f"skipped: there are no meshes in {meshes}; only those of data are compared")
    num_written = 0
    for number, file in enumerate(files):
        output = f"out.{FORMATS[number % len(FORMATS)]}"
        written = compare("remesh", "-q", here(file), output, "-n", (300, 1000, 2000)[number % 3], output=output)
        num_written += bool(written)
    print(f"the same bytes and words for {len(files)} meshes; {num_written} have a result")
    check(num_written >= (20 if meshes.exists() else 5), True, "number of meshes with a result")


def check_programs():
    part = here(data / "part.off")
    for arguments in [["--max-distance", "1%", "--adaptive"], ["--wrap", "2%", "-n", 1500], ["-n", 600]]:
        check(bool(compare("remesh", "-q", part, "out.ply", *arguments, output="out.ply")), True, "a mesh")
    check(b"distance" in compare("remesh-eval", part, "out.ply", "--report", "-"), True, "a report")
    compare("agvd", "diagram", "-q", part, "-n", 50, "-o", "out.agvd", output="out.agvd")
    compare("agvd", "distance", "-q", part, "-n", 5, "-o", "out.csv", output="out.csv")
    compare("remesh", "--help")
    compare("remesh", "--no-such-option")
    compare("remesh", "-q", "none.off", "out.ply")
    compare("remesh", "-q", ".", "out.ply")
    compare("remesh", "-q", data / "ring.obj", work / "out.ply", "-n", 300, output="out.ply")  # /path is no option.
    joined = []
    for folder in windows, linux:
        shutil.rmtree(work / "tiles", ignore_errors=True)
        for step in ["split", here(data / "organic.ply"), "tiles", "-n", "3000", "--tile", "1000"], ["mesh", "tiles"], ["join", "tiles", "out.ply"]:
            check(run(folder, "remesh-tiles", *step, "-q").returncode, 0, f"remesh-tiles {step}")
        joined.append(content("out.ply"))
    check(*joined, "remesh-tiles")


def check_names_and_lines():
    text = (data / "part.off").read_bytes()
    plain = compare("remesh", "-q", here(data / "part.off"), "out.ply", "-n", 600, output="out.ply")
    (work / FOLDER).mkdir(parents=True)
    for name in "plain 0.off", "plain é.off":
        (work / FOLDER / name).write_bytes(text)
    (work / FOLDER / "lines.off").write_bytes(text.replace(b"\n", b"\r\n"))
    for name in "plain é", "lines":
        output = f"{FOLDER}/{name}.ply"
        check(compare("remesh", "-q", f"{FOLDER}/{name}.off", output, "-n", 600, output=output) == plain, True, f"bytes of {name}")
    check(f"{FOLDER}/none.off" in run(windows, "remesh", f"{FOLDER}/none.off", "out.ply").stderr.decode(), True, "a name in UTF-8")
    # Programs look for the files of a pattern.
    check(run(windows, "remesh", "-q", f"{FOLDER}/plain*.off", "--out-dir", f"{FOLDER}/é", "--to", "ply", "-n", 600).returncode, 0, "a pattern")
    for name in "plain 0.ply", "plain é.ply":
        check(content(f"{FOLDER}/é/{name}") == plain, True, f"bytes of {name}")
    # The result names the file of materials beside the input as it is seen from its own folder.
    (work / FOLDER / "é.mtl").write_text("newmtl red\n")
    (work / FOLDER / "red.obj").write_text("mtllib é.mtl\nusemtl red\n" + (data / "ring.obj").read_text())
    red = compare("remesh", "-q", f"{FOLDER}/red.obj", "out.obj", "-n", 300, output="out.obj")
    check(f"mtllib {FOLDER}/é.mtl\n".encode() in red, True, "the name of a file of materials")
    piped = compare("remesh", "-q", "-", "-", "--from", "off", "--to", "ply", "-n", 600, input=text)
    check(piped == plain, True, "bytes of a pipe")


def only(names):
    check(sorted(path.name for path in (work / "old").iterdir()), sorted(names), "files in the folder")


def check_replacing():
    organic = here(data / "organic.ply")
    (work / "old").mkdir()
    old = work / "old" / "mesh.ply"
    old.write_bytes(b"old")
    # Its topology needs more vertices.
    compare("remesh", "-q", organic, "old/mesh.ply", "-n", 4)
    check(old.read_bytes(), b"old", "the old file")
    check(run(windows, "remesh", "-q", organic, "old/mesh.ply", "-n", 500).returncode, 0, "exit code")
    check(old.read_bytes() == compare("remesh", "-q", organic, "out.ply", "-n", 500, output="out.ply"), True, "the new file")
    old.write_bytes(b"old")
    old.chmod(0o444)
    done = run(windows, "remesh", "-q", organic, "old/mesh.ply", "-n", 500)
    check((done.returncode, b"make the old file writable" in done.stderr, old.read_bytes()), (3, True, b"old"), "a file that is read-only")
    old.chmod(0o644)
    # For the console wine may start its desktop, which would keep pipes open.
    done = run(windows, "interrupt", 2, str(windows / "remesh.exe"), organic, "old/mesh.ply", "--relax", 1000, "-n", 20000,
               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    check((done.returncode, old.read_bytes()), (130, b"old"), "Ctrl-C")
    only(["mesh.ply"])


def seconds(folder, mesh, threads):
    best = 1e9
    for _ in range(3):
        start = time.monotonic()
        check(run(folder, "remesh", "-q", mesh, "out.ply", "-t", threads).returncode, 0, "exit code")
        best = min(best, time.monotonic() - start)
    return best


def check_threads():
    mesh = here(data / "organic.ply")
    results = {threads: compare("remesh", "-q", mesh, "out.ply", "-t", threads, output="out.ply") for threads in (1, 2, 8, 0)}
    check(len(set(results.values())), 1, "number of results with 1, 2 and 8 threads")
    times = [[seconds(folder, mesh, threads) for threads in (1, 2)] for folder in (windows, linux)]
    for name, (one, two) in zip(("wine", "Linux"), times):
        print(f"{name}: {one:.2f} s with one thread, {two:.2f} s with two, ratio {two / one:.2f}")


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
# As long as it waits for its input, wine's services run. Otherwise each program would start them, and get their messages.
with subprocess.Popen(["wine", "cmd"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as waiting:
    try:
        time.sleep(2)
        for checks in check_replacing, check_names_and_lines, check_programs, check_meshes, check_threads:
            checks()
            print(f"{checks.__name__}: as it should be", flush=True)
    finally:
        waiting.kill()  # Without an end of its input it may wait for ever.
