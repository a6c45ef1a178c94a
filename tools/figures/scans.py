"""Scans that the program renders or captures, kept by what they are made of and shared by all sections and scripts."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import time

from inputs import ROOT, version_of

KEPT = ROOT / "out" / "figures" / "scans"
MOST_BYTES = 8 << 30  # of all scans; those that were used longest ago go first


def options_sorted(words):
    """Arguments with their options in alphabetic order; words before the first option stay in front."""
    groups = [[]]
    for word in words:
        if word.startswith("--"):
            groups.append([])
        groups[-1].append(word)
    return [word for group in groups[:1] + sorted(groups[1:]) for word in group]


def scan_key(verb, arguments):
    """The checksum of a verb's arguments, of the bytes of the files among them, and of the sources of the verb."""
    words = [
        f"bytes {hashlib.sha256(pathlib.Path(word).read_bytes()).hexdigest()}" if pathlib.Path(word).is_file() else word
        for word in map(str, arguments)
    ]
    return hashlib.sha256(json.dumps([verb, version_of(verb), options_sorted(words)]).encode()).hexdigest()[:16]


def bytes_of(folder):
    return sum(file.stat().st_blocks * 512 for file in folder.rglob("*") if file.is_file())


class Scans:
    """The kept scans. Each is a folder KEY beside KEY.json, whose time is that of its last use."""

    def __init__(self, program):
        self.program = program
        self.in_use = set()  # keys that are not removed to make room
        KEPT.mkdir(parents=True, exist_ok=True)

    def made(self, verb, *arguments):
        """The folder that `frangia VERB ARGUMENTS -o FOLDER` writes; it is shared, so nobody changes it."""
        key = scan_key(verb, arguments)
        folder, card = KEPT / key, KEPT / f"{key}.json"
        self.in_use.add(key)
        if not card.exists():
            unfinished = KEPT / f"unfinished-{key}-{os.getpid()}"
            shutil.rmtree(unfinished, ignore_errors=True)
            run = subprocess.run(
                [self.program, "--json", verb, *map(str, arguments), "-o", unfinished], capture_output=True, text=True
            )
            if run.returncode != 0:
                shutil.rmtree(unfinished, ignore_errors=True)
                raise subprocess.CalledProcessError(run.returncode, run.args, run.stdout, run.stderr)
            shutil.rmtree(folder, ignore_errors=True)
            unfinished.rename(folder)
            words = " ".join(map(str, arguments))
            card.write_text(
                json.dumps(
                    {
                        "verb": verb,
                        "version": version_of(verb),
                        "arguments": words,
                        "bytes": bytes_of(folder),
                        "answer": run.stdout,
                    }
                )
            )
            self.make_room()
        os.utime(card)
        return folder

    def answer(self, folder):
        """The JSON answer of the program that made the folder."""
        return json.loads(json.loads(folder.with_suffix(".json").read_text())["answer"])

    def make_room(self, most_bytes=None):
        """Removes the scans that were used longest ago until the rest fits, but none that is in use."""
        most_bytes = MOST_BYTES if most_bytes is None else most_bytes
        cards = sorted(KEPT.glob("*.json"), key=lambda card: card.stat().st_mtime)
        total = sum(json.loads(card.read_text())["bytes"] for card in cards)
        for card in cards:
            if total <= most_bytes:
                return
            if card.stem not in self.in_use:
                total -= json.loads(card.read_text())["bytes"]
                remove(card)

    def remove_stale(self):
        """Removes scans by other sources of their verb, and what an interruption left more than a day ago."""
        for card in KEPT.glob("*.json"):
            scan = json.loads(card.read_text())
            if scan["version"] != version_of(scan["verb"]):
                remove(card)
        for folder in KEPT.glob("*/"):
            if not folder.with_suffix(".json").exists() and folder.stat().st_mtime < time.time() - 86400:
                shutil.rmtree(folder, ignore_errors=True)


def remove(card):
    card.unlink()  # first, so that an interruption leaves no card without its scan
    shutil.rmtree(card.with_suffix(""), ignore_errors=True)
