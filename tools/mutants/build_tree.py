"""Compiles one changed source of a module, links the module's test program with it, and runs tests of that program.

The commands are those of a configured and built tree. The object of the changed source goes first into the link, and
its functions replace those of the module's library (`-z muldefs`). That is right because the libraries are position
independent: g++ then calls functions of other sources by their symbols and never inlines them, even where several
sources are compiled as one."""
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess

MEMORY_BYTES = 8 << 30  # a changed capacity must not take the machine


class Unusable(Exception):
    """A build tree or a module that cannot be used, in one sentence."""


def replaced(words, option, value):
    """The words with the value after an option replaced; without both where the value is None."""
    if option not in words:
        return words
    at = words.index(option)
    return words[:at] + ([option, value] if value is not None else []) + words[at + 2 :]


class BuildTree:
    def __init__(self, root, tree, work, module):
        self.root, self.tree, self.work, self.module = root, tree, work, module
        self.source_root = work / "src"
        self.object = work / "changed.o"
        self.program = work / f"test_{module}"
        # The user goes on editing the headers meanwhile.
        shutil.copytree(root / "src", self.source_root)
        self.commands = self._commands_by_source()
        self.link_words = self._link_words()
        self.header = None

    def _commands_by_source(self):
        """The compiler's words for each source of the module; those of a unity unit are for each source in it."""
        found = {}
        for entry in json.loads((self.tree / "compile_commands.json").read_text()):
            unit = pathlib.Path(entry["file"])
            sources = [str(unit)]
            if "/Unity/" in str(unit):
                sources = re.findall(r'#include "([^"]+)"', unit.read_text())
            for source in sources:
                if f"/src/frangia/{self.module}/" in source:
                    words = shlex.split(entry["command"])
                    if "-fPIC" not in words or "-fno-semantic-interposition" in words or "-flto" in words:
                        raise Unusable(
                            f"{source} is compiled without -fPIC, so that a changed function could be inlined; "
                            "configure with CMAKE_POSITION_INDEPENDENT_CODE and without LTO"
                        )
                    found[os.path.relpath(source, self.root)] = words
        return found

    def _link_words(self):
        printed = subprocess.run(
            ["ninja", "-C", self.tree, "-t", "commands", f"test_{self.module}"], capture_output=True, text=True
        )
        if printed.returncode:
            raise Unusable(
                f"{self.tree} has no program test_{self.module}: src/frangia/{self.module} needs tests in "
                f"tests/{self.module}"
            )
        link = next(part for part in printed.stdout.splitlines()[-1].split(" && ") if " -o " in part)
        words = shlex.split(link)
        self.built_program = self.tree / words[words.index("-o") + 1]
        if not self.built_program.exists():
            raise Unusable(f"{self.built_program} is not built: cmake --build {self.tree} --target {self.program.name}")
        words = replaced(words, "-o", str(self.program))
        first_object = next(i for i, word in enumerate(words) if word.endswith(".o"))
        linker = next((["-fuse-ld=" + name] for name in ("mold", "lld", "gold") if shutil.which("ld." + name)), [])
        return (
            words[:first_object]
            + linker
            + ["-Wl,-z,muldefs", "-Wl,--as-needed", str(self.object)]
            + words[first_object:]
        )

    def _quick(self, words):
        """A compiler's words for a module's source, made quick and for the copy of the sources."""
        words = [
            word.replace(str(self.root / "src"), str(self.source_root))
            for word in words
            if word not in ("-MD", "-Werror")
        ]
        words = [re.sub(r"^-O[23s]$", "-O1", word) for word in words]
        for option in ("-MT", "-MF"):
            words = replaced(words, option, None)
        return words + ["-w"]

    def _precompile(self, words):
        """The words with the common headers precompiled for these very options."""
        if "-include" not in words:
            return words
        text = pathlib.Path(words[words.index("-include") + 1])
        if self.header is None:
            self.header = self.work / "common" / text.name
            self.header.parent.mkdir()
            shutil.copy(text, self.header)
            making = replaced(
                replaced(replaced(words, "-include", None), "-c", str(self.header)), "-o", f"{self.header}.gch"
            )
            at = making.index("-c")
            self._call(making[:at] + ["-x", "c++-header"] + making[at:], check=True)
        return replaced(words, "-include", str(self.header))

    def _call(self, words, check=False):
        done = subprocess.run(words, cwd=self.tree, capture_output=True, text=True)
        if check and done.returncode:
            raise Unusable(f"the compiler fails on an unchanged source: {done.stderr[:400]}")
        return done.returncode == 0

    def compile(self, path, text):
        """The object's bytes of a source of the module with this text, or None where it does not compile."""
        (self.source_root.parent / path).write_text(text)
        words = self._precompile(self._quick(self.commands[path]))
        words = replaced(replaced(words, "-c", str(self.source_root.parent / path)), "-o", str(self.object))
        done = self._call(words)
        return self.object.read_bytes() if done else None

    def link(self):
        """Whether the program links with the last object: a changed constant may ask for what is nowhere."""
        return self._call(self.link_words)

    def run(self, program, names, cpu_s, *options):
        """Runs tests of a program; returns whether they passed, their processor time and their output. A test
        that takes more than cpu_s of processor time, or waits for long, is a failure."""

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_s) + 1, int(cpu_s) + 2))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        log = self.work / "tests.log"
        with log.open("w") as sink:
            process = subprocess.Popen(
                [program, f"--gtest_filter={':'.join(names)}", "--gtest_brief=1", *options],
                cwd=self.work,
                stdin=subprocess.DEVNULL,
                stdout=sink,
                stderr=sink,
                preexec_fn=limit,
                start_new_session=True,
            )
            try:
                code = process.wait(timeout=60 + 20 * cpu_s)
            except subprocess.TimeoutExpired:
                code = None
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)  # what a test has started and left
                except ProcessLookupError:
                    pass
                process.wait()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return code == 0, used_s, log.read_text(errors="replace")

    def tests(self, program):
        """Name and source of each test."""
        listing = self.work / "list.json"
        subprocess.run(
            [program, "--gtest_list_tests", f"--gtest_output=json:{listing}"], check=True, capture_output=True
        )
        return {
            f"{suite['name']}.{test['name']}": pathlib.Path(test["file"])
            for suite in json.loads(listing.read_text())["testsuites"]
            for test in suite["testsuite"]
        }
