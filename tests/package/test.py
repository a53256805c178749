"""Weir as other projects take it:  test.py BUILD_FOLDER

The README's example is built against the installed package, and runs. In a project that says no
build type, and adds Weir's folder, the library is compiled for speed, and is not installed with it.
Where a project joins its files into larger ones (unity builds) the library's stay as they are.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")


def from_package(build, temporary):
    run("cmake", "--install", build, "--prefix", temporary / "there")
    run("cmake", "-S", HERE, "-B", temporary / "with_package",
        f"-DCMAKE_PREFIX_PATH={temporary / 'there'}")
    run("cmake", "--build", temporary / "with_package")
    run(temporary / "with_package" / "game")


def from_folder(temporary):
    folder = temporary / "with_folder"
    run("cmake", "-S", HERE, "-B", folder, f"-DWEIR_SOURCE={ROOT}", "-DCMAKE_UNITY_BUILD=ON")
    for entry in json.loads((folder / "compile_commands.json").read_text()):
        if "/weir/" in entry["file"] and "nity" in pathlib.Path(entry["file"]).name:
            sys.exit(f"{entry['file']} joins files of the library")
        if "/lib/" in entry["file"] and not {"-O2", "-Os"} & set(entry["command"].split()):
            sys.exit(f"{entry['file']} is compiled without optimisation")
    if "libweir" in (folder / "cmake_install.cmake").read_text() or any(
            "libweir" in path.read_text() for path in folder.glob("weir/**/cmake_install.cmake")):
        sys.exit("a game that contains Weir installs it")


with tempfile.TemporaryDirectory() as name:
    from_package(pathlib.Path(sys.argv[1]), pathlib.Path(name))
    from_folder(pathlib.Path(name))
