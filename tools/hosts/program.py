"""Runs the programs remesh and agvd for a host: finds them, reads their progress, stops them."""

import json
import os
import re
import shutil
import subprocess
import sysconfig
import threading


class Failed(Exception):
    """A program cannot be run, or has failed; the text is for the user."""


class Stopped(Exception):
    """The user has stopped a program."""


def find(name, folder=""):
    """The path of a program: in the folder, in $REMESH_PROGRAMS, in PATH, or where pip and cmake --install put it."""
    places = [folder, os.environ.get("REMESH_PROGRAMS", ""), *os.get_exec_path(), sysconfig.get_path("scripts"),
              os.path.expanduser("~/.local/bin"), "/usr/local/bin"]
    path = shutil.which(name, path=os.pathsep.join(place for place in places if place))
    if not path:
        raise Failed(f"the program {name} is not found. Install remesh (its Debian package, or cmake --install), or "
                     "name the folder of its programs in the environment variable REMESH_PROGRAMS or, in Blender, in "
                     "the preferences of the add-on")
    return os.path.abspath(path)


class Run:
    """A program that runs."""

    def __init__(self, name, arguments, folder, programs=""):
        """Starts it. Names of files in the arguments count from `folder`; `programs` may be where it is."""
        self.fraction, self.stage, self.lines = 0.0, "start", []
        self._is_stopped = False
        command = [find(name, programs), *map(str, arguments)]
        if name != "remesh-eval":  # It has no such option.
            command += ["--progress", "json"]
        self._process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            encoding="utf-8", errors="replace", creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0))
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            if line.startswith("{"):
                state = json.loads(line)
                self.fraction, self.stage = state["progress"], state["stage"]
            else:
                self.lines.append(re.sub(r"\bin\.(ply|vtp): ", "", line.strip()))

    def wait(self, seconds=None):
        """Waits at most so long; returns whether the program has ended."""
        self._reader.join(seconds)
        return not self._reader.is_alive()

    def stop(self):
        self._is_stopped = True
        self._process.terminate()

    def result(self):
        """Waits for the end. Returns the texts of `key: text` lines by their keys; those of warnings as one list."""
        self.wait()
        self._process.stderr.close()
        code = self._process.wait()
        if self._is_stopped:
            raise Stopped("stopped, nothing has changed")
        if code != 0:
            errors = [line.split("error: ", 1)[1] for line in self.lines if "error: " in line]
            raise Failed("; ".join(errors) or f"the program ended with exit code {code}: " + " ".join(self.lines))
        texts = dict(line.split(": ", 1) for line in self.lines if ": " in line)
        texts["warning"] = [line[len("warning: "):] for line in self.lines if line.startswith("warning: ")]
        return texts


def verdict(texts):
    """What remesh says of its result, in one line."""
    return "; ".join(f"{key}: {texts[key]}" for key in ("result", "watertight", "triangles") if key in texts)
