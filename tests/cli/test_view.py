"""carom view: the page of a scene on this machine alone, which follows the file."""

import http.client
import os
import re
import signal
import socket
import subprocess
import time
import unittest

from long_work import GAS
from program import CAROM, SMALL_SCENE, ProgramTest, run


class View(ProgramTest):
    def serve(self, *more):
        """A running server of the scene; its port."""
        self.server = subprocess.Popen([CAROM, "view", str(self.scene), *more],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.server.stdout.close)
        self.addCleanup(self.server.stderr.close)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.kill)
        address = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\n", self.server.stdout.readline())
        self.port = int(address[1])

    def get(self, path="/", host=None, method="GET"):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, path, headers={"Host": host or f"127.0.0.1:{self.port}"})
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, text

    def page_with(self, pattern):
        """The page, as soon as it has that."""
        for _ in range(600):
            status, text = self.get()
            self.assertEqual(200, status)
            if re.search(pattern, text):
                return text
            time.sleep(0.1)
        self.fail(f"no page with {pattern}")

    def test_the_page_follows_the_file(self):
        self.serve("--backend", "osmesa")
        first = self.page_with('id="motion"')
        revision = self.get("/revision")[1]
        self.assertTrue(f'data-number="{revision}"' in first)
        self.assertTrue("connect-src 'self'" in first)
        self.scene.write_text("title: </title><script>alert(1)</script>\n" + SMALL_SCENE)
        second = self.page_with("&lt;/title&gt;")
        self.assertFalse("<script>alert" in second)
        self.assertNotEqual(revision, self.get("/revision")[1])
        self.scene.write_text(SMALL_SCENE.replace("radius", "raduis"))
        wrong = self.page_with(r"scene.yaml:8:\d+: error")
        self.assertTrue("raduis" in wrong and "did you mean" in wrong)
        os.replace(self.write("new.yaml", SMALL_SCENE), self.scene)
        self.page_with('id="motion"')

    def test_the_page_follows_the_scene_that_it_is_shown_against(self):
        other = self.write("other.yaml", SMALL_SCENE)
        self.scene.write_text(SMALL_SCENE + "against: {scene: other.yaml}\n")
        self.serve()
        self.page_with('id="second"')
        other.write_text(SMALL_SCENE.replace("radius", "raduis"))
        self.assertTrue("raduis" in self.page_with(r"other.yaml:8:\d+: error"))
        other.write_text(SMALL_SCENE)
        self.page_with('id="second"')
        self.scene.write_text(SMALL_SCENE)
        self.page_with('id="motion"(?!.*id="second")')

    def test_a_page_says_that_the_scene_is_simulated(self):
        self.scene.write_text(GAS)
        self.serve()
        page = self.get()[1]
        self.assertIn("The scene is simulated", page)
        self.assertNotIn("cannot be shown", page)

    def test_no_other_file_no_other_host_no_other_machine(self):
        self.serve()
        self.page_with('id="motion"')
        for path in ("/scene.yaml", "/../scene.yaml", "//etc/passwd", "/revision/x", "/?x"):
            self.assertEqual(404, self.get(path)[0], path)
        self.assertEqual(403, self.get(host="example.org")[0])
        self.assertEqual(403, self.get(host=f"example.org:{self.port}")[0])
        self.assertEqual(200, self.get(host=f"localhost:{self.port}")[0])
        self.assertIn(self.get(method="POST")[0], (405, 501))
        for name in {entry[4][0] for entry in socket.getaddrinfo(socket.gethostname(), None,
                                                                 socket.AF_INET)}:
            if not name.startswith("127."):
                with self.assertRaises(OSError):
                    socket.create_connection((name, self.port), timeout=5)

    def test_it_ends_with_an_interrupt_and_says_a_busy_port(self):
        self.serve()
        busy = run("view", self.scene, "--port", self.port)
        self.assert_exit(1, busy)
        self.assertIn(f"--port {self.port}: 127.0.0.1 does not give this port", busy.stderr)
        self.server.send_signal(signal.SIGINT)
        self.assertEqual(130, self.server.wait(timeout=60))

    def test_what_cannot_be_watched(self):
        self.assert_exit(2, run("view", "-"))
        self.assert_exit(2, run("view", self.folder / "none.yaml"))
        self.assert_exit(2, run("view", self.scene, "--port", "70000"))
        self.assert_exit(2, run("view", self.scene, "--set", "nonsense"))


if __name__ == "__main__":
    unittest.main()
