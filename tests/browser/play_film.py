"""Plays a film in headless Chromium: loads it, seeks to the middle, and looks at the picture.

usage: play_film.py FILM.mp4 [PICTURE.png]
Fails unless the browser reports a duration, seeks, and shows a picture with many colours.
"""

import base64
import functools
import http.server
import json
import pathlib
import subprocess
import sys
import tempfile
import threading

PAGE = """<!doctype html><video id="v" muted preload="auto" src="/film.mp4"></video><script>
const video = document.getElementById('v');
const report = (result) => fetch('/report', {method: 'POST', body: JSON.stringify(result)});
video.onerror = () => report({error: video.error.message});
video.onloadeddata = () => { video.currentTime = video.duration / 2; };
video.onseeked = () => {
  const canvas = document.createElement('canvas');
  canvas.width = video.videoWidth; canvas.height = video.videoHeight;
  const context = canvas.getContext('2d');
  context.drawImage(video, 0, 0);
  const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
  const colours = new Set();
  for (let i = 0; i < data.length; i += 4) colours.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
  report({duration: video.duration, time: video.currentTime, width: canvas.width, height: canvas.height,
          colours: colours.size, png: canvas.toDataURL('image/png')});
};
</script>"""

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-quic"]
LEAST_COLOURS = 1000


class Handler(http.server.BaseHTTPRequestHandler):
    """Serves the page and the film (with byte ranges, which seeking needs), takes the report."""

    def __init__(self, film, reports, *arguments):
        self.film = film
        self.reports = reports
        super().__init__(*arguments)

    def log_message(self, *_):
        pass

    def do_GET(self):
        if self.path == "/film.mp4":
            self.send_film()
        elif self.path == "/":
            self.send(200, "text/html", PAGE.encode())
        else:
            self.send(404, "text/plain", b"")

    def do_POST(self):
        length = int(self.headers["Content-Length"])
        self.reports.append(json.loads(self.rfile.read(length)))
        self.send(200, "text/plain", b"")
        threading.Thread(target=self.server.shutdown).start()

    def send_film(self):
        wanted = self.headers.get("Range")
        if wanted is None:
            self.send(200, "video/mp4", self.film, {"Accept-Ranges": "bytes"})
            return
        first, _, last = wanted.removeprefix("bytes=").partition("-")
        begin, end = int(first), int(last) if last else len(self.film) - 1
        self.send(206, "video/mp4", self.film[begin : end + 1],
                  {"Accept-Ranges": "bytes", "Content-Range": f"bytes {begin}-{end}/{len(self.film)}"})

    def send(self, status, kind, body, headers=()):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        for name, value in dict(headers).items():
            self.send_header(name, value)
        self.end_headers()
        try:
            self.wfile.write(body)
        except (BrokenPipeError, ConnectionResetError):
            pass  # the browser had enough of this range


def play(film):
    """What the page reported."""
    reports = []
    handler = functools.partial(Handler, pathlib.Path(film).read_bytes(), reports)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    with tempfile.TemporaryDirectory() as profile:
        browser = subprocess.Popen(
            ["chromium", *FLAGS, f"--user-data-dir={profile}", "--remote-debugging-port=0",
             f"http://127.0.0.1:{server.server_port}/"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        limit = threading.Timer(90, server.shutdown)
        limit.start()
        server.serve_forever()
        limit.cancel()
        browser.terminate()
        browser.wait(30)
    return reports[0] if reports else {"error": "no report from the browser within 90 s"}


def main():
    film = sys.argv[1]
    report = play(film)
    if "error" in report:
        sys.exit(f"{film}: {report['error']}")
    if len(sys.argv) > 2:
        pathlib.Path(sys.argv[2]).write_bytes(base64.b64decode(report["png"].split(",")[1]))
    print(f"{film}: {report['width']}x{report['height']}, {report['duration']:.3f} s, at {report['time']:.3f} s "
          f"a picture of {report['colours']} colours")
    if abs(report["time"] - report["duration"] / 2) > 0.1 or report["colours"] < LEAST_COLOURS:
        sys.exit(f"{film}: the middle is not shown")


if __name__ == "__main__":
    main()
