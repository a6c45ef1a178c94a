"""A GRBL board on a pseudo-terminal: it drives the table, the laser is its spindle (M3, M5), the lamp its coolant."""
import os
import pty
import re
import select
import threading
import time
import tty

GREETING = b"\r\nGrbl 1.1h ['$' for help]\r\n"
SETTINGS = {20: 0, 22: 0, 24: 100, 25: 2000, 27: 1, 100: 88.889, 110: 7200, 120: 5000, 130: 720}

FAULTS = ("silent", "chatter", "endless line", "garbage", "alarm", "restart", "unplugged", "slow answers", "never idle")


class GrblBoard:
    """Answers as GRBL 1.1 does, and misbehaves in one of FAULTS from the command `fault_at` on."""

    def __init__(self, fault="", fault_at=10**9):
        self.fault, self.fault_at = fault, fault_at
        self.commands = 0
        self.on = {"spindle": False, "coolant": False}
        self.switched_off_at = time.monotonic()
        self.position = 0.0
        self.line, self.alarm = b"", False
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.port = os.ttyname(self.slave)
        self.stopping = threading.Event()
        self.thread = threading.Thread(target=self._serve, daemon=True)
        self.thread.start()

    def is_lit(self):
        return any(self.on.values())

    def close(self):
        self.stopping.set()
        self.thread.join()
        for descriptor in (self.master, self.slave):
            try:
                os.close(descriptor)
            except OSError:
                pass

    def _is(self, fault):
        return self.fault == fault and self.commands >= self.fault_at

    def _say(self, text):
        if self._is("silent"):
            return
        if self._is("garbage"):
            text = bytes((byte * 7 + 131) % 256 for byte in text)
        if self._is("slow answers"):
            time.sleep(0.4)
        os.set_blocking(self.master, False)
        try:
            os.write(self.master, text)
        except OSError:
            pass

    def _serve(self):
        self._say(GREETING)
        while not self.stopping.is_set():
            if self._is("unplugged"):
                os.close(self.master)
                self._switch("spindle", False), self._switch("coolant", False)  # without power
                return
            ready, _, _ = select.select([self.master], [], [], 0.03)
            if self._is("chatter"):
                self._say(b"[MSG:still here]\r\n")
            if self._is("endless line"):
                self._say(b"x" * 64)
            if ready:
                try:
                    received = os.read(self.master, 1024)
                except OSError:
                    time.sleep(0.01)
                    continue
                for i in range(len(received)):
                    self._receive(received[i : i + 1])

    def _switch(self, output, on):
        after = self.on | {output: on}
        if self.is_lit() and not any(after.values()):
            self.switched_off_at = time.monotonic()  # before the change, which other threads wait for
        self.on = after

    def _receive(self, byte):
        if byte == b"\x18":
            self._switch("spindle", False), self._switch("coolant", False)
            self.line = b""
            self._say(GREETING)
        elif byte == b"?":
            state = "Alarm" if self.alarm else "Run" if self._is("never idle") else "Idle"
            self._say(f"<{state}|MPos:{self.position:.3f},0.000,0.000|FS:0,0>\r\n".encode())
        elif byte == b"\n":
            line, self.line = self.line.decode("latin-1").strip(), b""
            self._answer(line)
        elif byte not in b"!~\r":
            self.line += byte

    def _answer(self, line):
        self.commands += 1
        if line == "$$":
            self._say("".join(f"${key}={value}\r\n" for key, value in SETTINGS.items()).encode() + b"ok\r\n")
            return
        if line == "$X":
            self.alarm = False
        for word, output, on in (
            ("M3", "spindle", True),
            ("M5", "spindle", False),
            ("M8", "coolant", True),
            ("M9", "coolant", False),
        ):
            if line == word or line.startswith(word + " "):
                self._switch(output, on)
        if self._is("alarm") and "G1" in line:
            self.alarm = True
            self._switch("spindle", False), self._switch("coolant", False)
            self._say(b"ALARM:1\r\n[MSG:Reset to continue]\r\n")
            return
        if self._is("restart") and "G1" in line:
            self._switch("spindle", False), self._switch("coolant", False)
            self._say(GREETING)
            return
        if self._is("never idle") and line.startswith("G4"):
            return
        target = re.search(r"X(-?[\d.]+)", line)
        if target and "G1" in line:
            time.sleep(0.03)  # the move
            self.position = float(target[1])
        self._say(b"error:9\r\n" if self.alarm and line and not line.startswith("$") else b"ok\r\n")


def rig_with(board, frames, rig_text):
    """A rig.toml whose table and lights are outputs of the board and whose camera replays the frames of a scan."""
    head = rig_text.split("[devices.camera]")[0]
    return (
        head
        + f"""[devices.camera]
driver = "folder"
folder = "{frames}"

[devices.fringes]
driver = "simulated-piezo"
max_command = 12
command_per_turn = 10

[devices.light]
driver = "grbl"
port = "{board.port}"
on = "M8"
off = "M9"

[devices.line]
driver = "grbl"
port = "{board.port}"
on = "M3 S1000"
off = "M5"

[devices.turntable]
driver = "grbl"
port = "{board.port}"
boot_s = 0.1
home = "here"
units_per_degree = 1
speed_deg_per_s = 360
"""
    )
