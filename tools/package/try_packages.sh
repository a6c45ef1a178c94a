#!/bin/sh
# Installs the packages of a folder in a new Debian, uses each as its user would, and removes them:
# try_packages.sh FOLDER DOCKERFILE. The first packages are installed by the RUN lines of the last stage of DOCKERFILE. Needs
# root, debootstrap and a mirror.
set -eu
packages=$1
dockerfile=$2
root=$(mktemp -d)
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf "$root" "$root.log"' EXIT
debootstrap --variant=minbase bookworm "$root" >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
rm -f "$root/etc/apt/sources.list"
cp /etc/apt/sources.list "$root/etc/apt/" 2>/dev/null || true
cp -r /etc/apt/sources.list.d /etc/apt/apt.conf.d "$root/etc/apt/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mkdir "$root/packages"
cp "$packages"/*.deb "$packages"/*.whl "$root/packages"
mount -t proc proc "$root/proc"
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/root LC_ALL=C.UTF-8 sh -euc "$1"; }

awk '/^FROM /{ steps = "" } /^RUN /{ sub(/^RUN /, ""); steps = steps $0 "\n" } END { printf "%s", steps }' "$dockerfile" >"$root/steps.sh"
grep -q frangia "$root/steps.sh" || { echo "$dockerfile installs no package in its last stage"; exit 1; }
inside 'sh -eu /steps.sh && frangia --version'
inside 'apt-get install -y -qq --no-install-recommends /packages/*.deb cmake g++ make >/dev/null'
inside 'frangia --version && frangia --quiet simulate plate --views 2 -o /tmp/scan && frangia --quiet reconstruct /tmp/scan -o /tmp/mesh.dxf'
inside 'cd /tmp && cp -r /usr/share/doc/libfrangia-dev/examples/find_package example && cmake -S example -B built >/dev/null &&
  cmake --build built >/dev/null && built/scan_to_mesh /tmp/scan /tmp/mesh.ply'
inside 'python3 -c "
import frangia
scan = frangia.read_scan(\"/tmp/scan\")
print(frangia.__version__, frangia.reconstruct(scan).mesh)"'
inside 'test -s /usr/share/man/man1/frangia-reconstruct.1.gz && test -s /usr/share/doc/frangia-doc/phase.md'
# The wheel needs the libraries of Debian alone, not the other packages.
inside 'apt-get install -y -qq --no-install-recommends python3-venv >/dev/null'
inside 'apt-get remove -y -qq frangia libfrangia-dev python3-frangia frangia-doc >/dev/null && ! command -v frangia'
inside 'python3 -m venv --system-site-packages /venv && /venv/bin/pip install --quiet --no-index --no-deps /packages/frangia-*.whl'
inside '/venv/bin/frangia --quiet reconstruct /tmp/scan -o /tmp/again.stl && test -s /tmp/again.stl && cd /tmp && /venv/bin/python3 -c "
import frangia
assert frangia.__file__.startswith(\"/venv/\")
print(frangia.__version__, frangia.reconstruct(frangia.read_scan(\"/tmp/scan\")).mesh)"'
echo "the packages and the wheel were installed and used, the packages removed"
