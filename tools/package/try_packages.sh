#!/bin/sh
# Installs the packages of a folder in a new Debian, uses each as its user would, and removes them:
# try_packages.sh FOLDER. Needs root, debootstrap and a mirror.
set -eu
packages=$1
root=$(mktemp -d)
trap 'umount "$root/proc" 2>/dev/null; rm -rf "$root"' EXIT
debootstrap --variant=minbase bookworm "$root" >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
rm -f "$root/etc/apt/sources.list"
cp /etc/apt/sources.list "$root/etc/apt/" 2>/dev/null || true
cp -r /etc/apt/sources.list.d /etc/apt/apt.conf.d "$root/etc/apt/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
mount -t proc proc "$root/proc"
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/root LC_ALL=C.UTF-8 sh -euc "$1"; }

inside 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /packages/*.deb cmake g++ make >/dev/null'
inside 'frangia --version && frangia --quiet simulate plate --views 2 -o /tmp/scan && frangia --quiet reconstruct /tmp/scan -o /tmp/mesh.dxf'
inside 'cd /tmp && cp -r /usr/share/doc/libfrangia-dev/examples/find_package example && cmake -S example -B built >/dev/null &&
  cmake --build built >/dev/null && built/scan_to_mesh /tmp/scan /tmp/mesh.ply'
inside 'python3 -c "
import frangia
scan = frangia.read_scan(\"/tmp/scan\")
print(frangia.__version__, frangia.reconstruct(scan).mesh)"'
inside 'test -s /usr/share/man/man1/frangia-reconstruct.1.gz && test -s /usr/share/doc/frangia-doc/phase.md'
inside 'apt-get remove -y -qq frangia libfrangia-dev python3-frangia frangia-doc >/dev/null && ! command -v frangia'
echo "the packages were installed, used and removed"
