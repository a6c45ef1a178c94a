"""The writes of a program as strace records them, and the files that they leave after a power cut.

Two models of what a disk keeps: `ordered`, where every operation before the cut has arrived, and `reordered`, where only
synced data is certain, as POSIX defines it: of an unsynced file any prefix may remain, and an unsynced name may be the old or
the new one, each independently.
"""
import os
import re
import subprocess

CALLS = "openat,open,creat,write,writev,lseek,ftruncate,fsync,fdatasync,rename,renameat,renameat2,mkdir,mkdirat,unlink,unlinkat,close"
PATH = r"<((?:\\x[0-9a-f]{2})*)>"


def unescape(text):
    return bytes.fromhex(text.replace("\\x", ""))


def record(command, log, folder=None):
    """Runs a command under strace; returns its exit code. The search for leaks does not work under it."""
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
    return subprocess.run(
        ["strace", "-f", "-y", "-qq", "-xx", "-s", "4000000", "-e", f"trace={CALLS}", "-o", log, *command],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=environment,
        cwd=folder,
    ).returncode


def joined_lines(log):
    """Lines of strace, the two halves of a call that another thread interrupted joined, in the order of their ends."""
    open_calls = {}
    with open(log, encoding="latin-1") as file:
        for line in file:
            pid, call = line.rstrip("\n").split(None, 1)
            if call.endswith("<unfinished ...>"):
                open_calls[pid] = call[: -len("<unfinished ...>")].rstrip()
            elif call.startswith("<... "):
                yield open_calls.pop(pid, "") + re.sub(r"^<\.\.\. \w+ resumed>", "", call)
            else:
                yield call


def operations(log, folder):
    """The operations below a folder: (kind, path, ...) with paths as bytes relative to it."""
    root = str(folder).encode() + b"/"
    offsets = {}  # by descriptor

    def inside(path):
        path = path.replace(b"//", b"/")
        return path[len(root) :] if path.startswith(root) else b"" if path + b"/" == root else None

    for call in joined_lines(log):
        name = call.split("(", 1)[0]
        result = re.search(r"\) += (-?\d+)", call)
        if not result or int(result[1]) < 0:
            continue
        value = int(result[1])
        strings = [unescape(text) for text in re.findall(r'"((?:\\x[0-9a-f]{2})*)"', call)]
        descriptor = re.match(rf"\w+\((\d+){PATH}", call)
        if name in ("open", "openat", "creat"):
            path = inside(strings[0])
            if path is None:
                continue
            offsets[value] = 0
            flags = call.rsplit('"', 1)[1]
            if "O_CREAT" in flags or name == "creat":
                yield "create", path, "O_TRUNC" in flags
            elif "O_TRUNC" in flags:
                yield "truncate", path, 0
        elif name == "close" and descriptor:
            offsets.pop(int(descriptor[1]), None)
        elif descriptor and inside(unescape(descriptor[2])) is not None:
            fd, path = int(descriptor[1]), inside(unescape(descriptor[2]))
            if name in ("write", "writev"):
                yield "write", path, offsets.get(fd, 0), b"".join(strings)[:value]
                offsets[fd] = offsets.get(fd, 0) + value
            elif name == "lseek":
                offsets[fd] = value
            elif name == "ftruncate":
                yield "truncate", path, int(re.search(r">, (\d+)", call)[1])
            elif name in ("fsync", "fdatasync"):
                yield "sync", path
        elif name.startswith("rename"):
            source, target = inside(strings[0]), inside(strings[1])
            if target is not None and source is not None:
                yield "rename", source, target
        elif name.startswith("mkdir"):
            if inside(strings[0]):
                yield "mkdir", inside(strings[0])
        elif name.startswith("unlink"):
            if inside(strings[0]):
                yield "unlink", inside(strings[0])


def parent(path):
    return path.rsplit(b"/", 1)[0] if b"/" in path else b""


class Disk:
    """Files and names, each as the program sees it and as is certain after a power cut."""

    def __init__(self):
        self.names = {b"": None}  # path: file, or None for a folder
        self.pending = []  # changes of names that are not synced: (folder, path, file or None, is removal)
        self.content, self.synced = {}, {}  # by file

    def apply(self, operation):
        kind, path = operation[0], operation[1]
        if kind == "create":
            if path not in self.names:
                file = len(self.content)
                self.content[file], self.synced[file] = bytearray(), b""
                self._name(path, file)
            elif operation[2]:
                self.content[self.names[path]] = bytearray()
        elif kind == "truncate" and path in self.names:
            data = self.content[self.names[path]]
            del data[operation[2] :]
        elif kind == "write" and self.names.get(path) is not None:
            data, offset = self.content[self.names[path]], operation[2]
            data.extend(bytes(max(0, offset + len(operation[3]) - len(data))))
            data[offset : offset + len(operation[3])] = operation[3]
        elif kind == "mkdir":
            self._name(path, None)
        elif kind == "unlink" and path in self.names:
            self.pending.append(({path: None}, {path}))
            del self.names[path]
        elif kind == "rename" and path in self.names:
            target = operation[2]
            moved = {old: target + old[len(path) :] for old in self.names if old == path or old.startswith(path + b"/")}
            self.pending.append(({moved[old]: self.names[old] for old in moved}, set(moved)))
            for old, new in moved.items():
                self.names[new] = self.names.pop(old)
        elif kind == "sync":
            if self.names.get(path) is not None:
                self.synced[self.names[path]] = bytes(self.content[self.names[path]])
            else:  # a folder: its names are certain
                self.pending = [
                    change
                    for change in self.pending
                    if not any(parent(p) == path for p in change[0] | dict.fromkeys(change[1]))
                ]

    def _name(self, path, file):
        self.names[path] = file
        self.pending.append(({path: file}, set()))

    def write_to(self, folder, random=None):
        """Writes what remains: all (ordered), or by chance what is not synced (reordered)."""
        names = dict(self.names)
        if random is not None:
            for added, removed in reversed(self.pending):
                if random.random() < 0.5:
                    continue  # this change of names arrived
                before = {path: names[path] for path in added if path in names and names[path] == added[path]}
                for path in before:
                    if path not in removed:
                        del names[path]
                if removed:
                    for old, new in zip(sorted(removed), sorted(added)):
                        if new in before:
                            names[old] = before[new]
            names = {
                path: file
                for path, file in names.items()
                if all(path[:i] in names for i in range(len(path)) if path[i : i + 1] == b"/")
            }
        folder.mkdir(parents=True, exist_ok=True)
        for path, file in sorted(names.items()):
            target = folder / path.decode()
            if file is None:
                target.mkdir(parents=True, exist_ok=True)
                continue
            data, certain = bytes(self.content[file]), self.synced[file]
            if random is not None and data != certain:
                if data[: len(certain)] == certain:  # appended: any prefix of what is not synced
                    data = data[: random.randint(len(certain), len(data))]
                else:
                    data = random.choice([certain, data, data[: random.randint(0, len(data))]])
            target.write_bytes(data)
