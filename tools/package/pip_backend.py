"""Builds the wheel and the source distribution for pip (PEP 517), with CMake and the packages of Debian, without network.

FRANGIA_BUILD_DIR names a build tree that is complete; without it, the wheel is compiled in build/wheel. The wheel holds the
package, the program with its app, and the licences. It is for the Debian on which it was built: it links that system's
libraries, which its metadata names by their packages (Requires-External).
"""
import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
WEB = "web-dist"  # the front end in a source distribution, built already
BUILD_TIME = (2026, 1, 1, 0, 0, 0)  # the same input gives the same bytes


def version():
    return re.search(r"project\(frangia VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def run(*command):
    subprocess.run([str(word) for word in command], cwd=SOURCE, check=True)


def build_tree():
    if os.environ.get("FRANGIA_BUILD_DIR"):
        return (SOURCE / os.environ["FRANGIA_BUILD_DIR"]).resolve()
    tree = SOURCE / "build" / "wheel"
    web = [f"-DFRANGIA_WEB_DIST={SOURCE / WEB}"] if (SOURCE / WEB).is_dir() else []
    run(
        "cmake",
        "--preset",
        "release",
        "-B",
        tree,
        "-DFRANGIA_TESTS=OFF",
        "-DFRANGIA_BENCHMARKS=OFF",
        "-DFRANGIA_WERROR=OFF",
        f"-DPython3_EXECUTABLE={sys.executable}",
        *web,
    )
    run("cmake", "--build", tree)
    return tree


def libraries_of(files):
    """The packages of Debian that hold the libraries which the files name."""
    names = set()
    for file in files:
        listing = subprocess.run(["objdump", "-p", file], capture_output=True, text=True, check=True).stdout
        names.update(re.findall(r"NEEDED +(\S+)", listing))
    found = subprocess.run(
        ["dpkg", "-S", *[f"*/{name}" for name in sorted(names)]], capture_output=True, text=True
    ).stdout
    return sorted({line.split(":")[0] for line in found.splitlines() if "diversion" not in line})


def metadata(libraries=()):
    project = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]
    lines = [
        "Metadata-Version: 2.1",
        "Name: frangia",
        f"Version: {version()}",
        f"Summary: {project['description']}",
        f"License: {project['license']['text']}",
        f"Requires-Python: {project['requires-python']}",
        *[f"Requires-Dist: {name}" for name in project["dependencies"]],
        *[f"Requires-External: {name}" for name in libraries],
        "Description-Content-Type: text/markdown",
        "",
        (SOURCE / "README.md").read_text(),
    ]
    return "\n".join(lines).encode()


class Wheel:
    """A wheel that is being written, with the record of its files."""

    def __init__(self, path):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.record = []

    def add(self, name, content, mode=0o644):
        entry = zipfile.ZipInfo(name, BUILD_TIME)
        entry.external_attr = (0o100000 | mode) << 16
        self.zip.writestr(entry, content, zipfile.ZIP_DEFLATED)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(content)}")

    def close(self, info):
        self.record.append(f"{info}/RECORD,,")
        self.zip.writestr(zipfile.ZipInfo(f"{info}/RECORD", BUILD_TIME), "\n".join(self.record) + "\n")
        self.zip.close()


def stripped(file, folder):
    copy = pathlib.Path(folder) / file.name
    shutil.copyfile(file, copy)
    run("strip", "--strip-unneeded", copy)
    return copy.read_bytes()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    tree = build_tree()
    program, on_demand = tree / "bin" / "frangia", sorted((tree / "lib" / "frangia").glob("*.so"))
    package = sorted(path for path in (tree / "python" / "frangia").iterdir() if path.is_file())
    if not program.exists() or not any(path.suffix == ".so" for path in package):
        sys.exit(f"{tree} does not hold the program and the Python package; build them there first")
    name, info = f"frangia-{version()}-{tag()}.whl", f"frangia-{version()}.dist-info"
    wheel = Wheel(pathlib.Path(wheel_directory) / name)
    with tempfile.TemporaryDirectory() as folder:
        for path in package:
            wheel.add(f"frangia/{path.name}", stripped(path, folder) if path.suffix == ".so" else path.read_bytes())
        for path in on_demand:  # which the program loads when it reads a CAD file
            wheel.add(f"frangia-{version()}.data/data/lib/frangia/{path.name}", stripped(path, folder))
        wheel.add(f"frangia-{version()}.data/scripts/frangia", stripped(program, folder), 0o755)
    compiled = [program, *on_demand, *[path for path in package if path.suffix == ".so"]]
    wheel.add(f"{info}/METADATA", metadata(libraries_of(compiled)))
    wheel.add(
        f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: frangia\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    )
    for licence in ("LICENSE", "NOTICE", "tools/package/licences.txt"):
        wheel.add(f"{info}/licenses/{pathlib.Path(licence).name}", (SOURCE / licence).read_bytes())
    wheel.close(info)
    return name


def sources():
    """What git tracks; in an unpacked source distribution, what it holds."""
    if (SOURCE / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, check=True).stdout.decode()
        return sorted(name for name in listed.split("\0") if name and (SOURCE / name).is_file())
    left_out = {"build", "out", WEB, "PKG-INFO"}
    return sorted(
        str(path.relative_to(SOURCE))
        for path in SOURCE.rglob("*")
        if path.is_file() and path.relative_to(SOURCE).parts[0] not in left_out and "__pycache__" not in path.parts
    )


def build_sdist(sdist_directory, config_settings=None):
    tree = SOURCE / os.environ.get("FRANGIA_BUILD_DIR", "build/release")
    web = SOURCE / WEB if (SOURCE / WEB).is_dir() else tree / "web" / "dist"
    if not (web / "index.html").exists():
        sys.exit(f"{web} does not hold the front end; build the program first: ./run build")
    top = f"frangia-{version()}"
    with tarfile.open(
        pathlib.Path(sdist_directory) / f"{top}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT, compresslevel=6
    ) as archive:
        for name in sources():
            archive.add(SOURCE / name, f"{top}/{name}", recursive=False)
        archive.add(web, f"{top}/{WEB}")
        text = metadata()
        entry = tarfile.TarInfo(f"{top}/PKG-INFO")
        entry.size = len(text)
        archive.addfile(entry, io.BytesIO(text))
    return f"{top}.tar.gz"
