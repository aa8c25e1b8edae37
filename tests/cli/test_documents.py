"""What the documents show is valid and up to date."""

import re
import unittest

from program import SOURCE, ProgramTest, run


class Documents(ProgramTest):
    def test_scenes_in_the_documents_are_valid(self):
        found = 0
        for document in (SOURCE / "README.md", SOURCE / "docs" / "scene.md"):
            for block in re.findall(r"^```yaml\n(.*?)^```", document.read_text(), re.M | re.S):
                if not block.startswith("carom: 1"):
                    continue
                found += 1
                self.assert_exit(0, run("check", self.write(f"{found}.yaml", block)))
        self.assertGreaterEqual(found, 2)

    def test_the_picture_of_the_readme_is_what_the_scene_draws(self):
        drawn = self.folder / "figure9.png"
        self.assert_exit(0, run("still", SOURCE / "scenes" / "figure9.yaml", "--time", 0.9, "-o", drawn))
        self.assert_exit(0, run("compare", SOURCE / "docs" / "figure9.png", drawn))

    def test_every_command_is_described(self):
        commands = re.findall(r"^  (\w+) +\S", run("--help").stdout.split("Commands:")[1], re.M)
        self.assertGreaterEqual(len(commands), 8)
        text = (SOURCE / "docs" / "commands.md").read_text()
        for command in commands:
            self.assertIn(f"`carom {command}", text)


if __name__ == "__main__":
    unittest.main()
