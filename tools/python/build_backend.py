"""Lets pip build and install the Python module: `pip install --no-build-isolation .`, or `pip wheel`

CMake does the work, in build/pip; a second run compiles what has changed. Only the standard library
is needed. The wheel holds the program `remesh`, and the shared libraries that not every Linux has. Options for CMake come from the environment variable REMESH_CMAKE_ARGS, such as
`-DAGVD_WITH_CGAL=OFF`, and are split as a shell would.
"""

import base64
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "pip"
NAME = "remesh"
# Shared libraries that a Python with NumPy has already.
EVERYWHERE = re.compile(r"ld-linux|linux-vdso|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    _configure()
    with tempfile.TemporaryDirectory() as folder:
        staging = Path(folder)
        _install(staging)
        _write_metadata(staging)
        wheel = Path(wheel_directory) / f"{_full_name()}-{_tag()}.whl"
        _pack(staging, wheel)
    return wheel.name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    _configure()
    return _write_metadata(Path(metadata_directory)).name


def build_sdist(sdist_directory, config_settings=None):
    _configure()
    archive = Path(sdist_directory) / f"{_full_name()}.tar.gz"
    subprocess.run(["git", "archive", "--format=tar.gz", f"--prefix={_full_name()}/",
                    f"--output={archive.resolve()}", "HEAD"], cwd=ROOT, check=True)
    return archive.name


def _configure():
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    # The same as release, but for what the module does not need.
    subprocess.run(["cmake", *generator, "-S", ROOT, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release",
                    "-DAGVD_BUILD_PYTHON=ON", "-DAGVD_BUILD_TOOLS=ON", "-DAGVD_BUILD_TESTS=OFF",
                    "-DAGVD_INSTALL=OFF", "-DAGVD_PYTHON_DIR=.", f"-DPython_EXECUTABLE={sys.executable}",
                    *shlex.split(os.environ.get("REMESH_CMAKE_ARGS", ""))], check=True)


def _install(staging):
    """Builds the module and the program, and puts the package into a folder."""
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    subprocess.run(["cmake", "--build", BUILD, "--target", "remesh_python", "remesh_program", "-j",
                    jobs], check=True)
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--strip",
                    "--prefix", staging], check=True)
    package = staging / NAME
    program = package / "bin" / NAME
    program.parent.mkdir()
    shutil.copy(BUILD / "tools" / NAME, program)
    subprocess.run(["strip", program], check=True)
    binaries = [program, *package.glob("*.so")]
    for library in {path for binary in binaries for path in _libraries_of(binary)}:
        shutil.copy(library, package)


def _libraries_of(binary):
    """The files of the shared libraries that it needs and not every Linux has."""
    listed = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"^\s*(\S+) => (\S+)", listed, re.MULTILINE)
    return [path for name, path in found if not EVERYWHERE.match(name)]


def _version():
    """That of the project, from the configured build."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    return re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.+)$", cache, re.MULTILINE)[1]


def _full_name():
    return f"{NAME}-{_version()}"


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-" + re.sub(r"[-.]", "_", sysconfig.get_platform())


def _write_metadata(folder):
    info = folder / f"{_full_name()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\n"
        "Summary: Geodesic Voronoi diagrams and remeshing of triangle surfaces\n"
        "Requires-Python: >=3.9\nRequires-Dist: numpy\n")
    (info / "WHEEL").write_text(
        f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {_tag()}\n")
    (info / "entry_points.txt").write_text("[pyvista.accessors]\nremesh = remesh._pyvista\n")
    shutil.copy(ROOT / "LICENSE", info)
    return info


def _pack(staging, wheel):
    """Writes the folder as a wheel, with the list of its files last."""
    rows = []
    record = f"{_full_name()}.dist-info/RECORD"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(p for p in staging.rglob("*") if p.is_file()):
            name = path.relative_to(staging).as_posix()
            content = path.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
            rows.append(f"{name},sha256={digest.decode()},{len(content)}")
            archive.write(path, name)
        archive.writestr(record, "\n".join([*rows, f"{record},,", ""]))
