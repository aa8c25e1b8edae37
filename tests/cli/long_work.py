"""Work that would take minutes, and what it needs, for tests that end it."""

import array
import fcntl
import os
import pathlib
import signal
import struct
import subprocess
import termios
import time
import zlib

from program import CAROM

# A ball that soon lies still: an hour of rows from a moment of simulation.
RESTING = """\
carom: 1
simulation: {duration: 1e6}
materials: {clay: {restitution: 0.1}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}}]
balls: [{name: a, radius: 0.1, material: clay, position: [0, 0, 0.2]}]
film: {size: [160, 90], fps: 1000}
"""

# Balls that never lose anything.
GAS = """\
carom: 1
simulation: {duration: 1e6}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}}
  - {name: left, plane: {normal: [1, 0, 0], offset: -1}}
  - {name: right, plane: {normal: [-1, 0, 0], offset: -1}}
  - {name: front, plane: {normal: [0, 1, 0], offset: -1}}
  - {name: back, plane: {normal: [0, -1, 0], offset: -1}}
balls: [{name: a, radius: 0.1, position: [-0.6, -0.6, 0.3], velocity: [1, 2, 0], repeat: {count: [4, 4, 2], spacing: 0.3}}]
film: {size: [160, 90], fps: 20}
"""


def png(path, width, height, grey=0x80):
    """A grey picture, large and quickly made."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packer = zlib.compressobj(1)
    row = b"\0" + bytes([grey]) * width
    data = b"".join(packer.compress(row * 100) for _ in range(height // 100)) + packer.flush()
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
                     + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def cpu_s(pid):
    """Of the process and its threads, or None when it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return None
    return None if fields[0] == "Z" else (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def watches_signals(pid):
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return False
    blocked = int(status.split("SigBlk:")[1].split()[0], 16)
    return bool(blocked & 1 << signal.SIGTERM - 1)


class LongWork:
    """A process that is in the midst of its work."""

    def __init__(self, *arguments, busy_s=0.3, has_written=False, **keywords):
        """Busy once it has taken so much CPU time, or, if it `has_written`, once its standard output holds
        something that nobody reads."""
        keywords.setdefault("stdin", subprocess.DEVNULL)
        keywords.setdefault("stdout", subprocess.PIPE)
        self.process = subprocess.Popen([CAROM, *map(str, arguments)], stderr=subprocess.PIPE, **keywords)
        self.busy_s = busy_s
        self.has_written = has_written

    def is_busy(self):
        if not watches_signals(self.process.pid):
            return False
        if not self.has_written:
            return (cpu_s(self.process.pid) or 0) >= self.busy_s
        waiting = array.array("i", [0])
        fcntl.ioctl(self.process.stdout, termios.FIONREAD, waiting)
        return waiting[0] > 0

    def wait_until_busy(self):
        end = time.monotonic() + 60
        while not self.is_busy():
            if self.process.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"{self.process.args} ended before: {self.process.communicate()[1]}")
            time.sleep(0.01)

    def end(self, *signals):
        """Sends them; the exit code, the seconds until the end, what was said."""
        start = time.monotonic()
        for number in signals:
            self.process.send_signal(number)
        try:
            self.process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
        took = time.monotonic() - start
        _, errors = self.process.communicate()
        return self.process.returncode, took, errors.decode()
