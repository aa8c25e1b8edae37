"""Figure 8 as a reader of the film sees it: the height of the ball's bottom, read off the drawn ruler."""

import math
import subprocess
import unittest

from program import SOURCE, ProgramTest, run

SCENE = SOURCE / "scenes" / "figure8.yaml"
WIDTH, HEIGHT = 1280, 720
MAJOR_MARKS_M = [2.0, 1.5, 1.0, 0.5, 0.0]  # from the top
RESTITUTION = math.exp(-4 * 0.42 / (2 * 5))
READING_ERROR_M = 0.006  # a pixel is 3.7 mm there, edges are soft


def pixels(path):
    """Rows of (r, g, b)."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         capture_output=True, check=True).stdout
    return [[raw[3 * (y * WIDTH + x) : 3 * (y * WIDTH + x) + 3] for x in range(WIDTH)] for y in range(HEIGHT)]


def is_ink(p):
    return max(p) < 170 and p[2] >= p[0] - 8


def clusters(rows):
    """Centres of runs of neighbouring rows."""
    groups = []
    for y in rows:
        if groups and y - groups[-1][-1] <= 1:
            groups[-1].append(y)
        else:
            groups.append([y])
    return [sum(g) / len(g) for g in groups]


def major_marks(picture):
    """Rows of the ruler's major marks: the column left of the staff that only the longest marks reach."""
    ink = [[y for y in range(HEIGHT) if is_ink(picture[y][x])] for x in range(WIDTH)]
    staff = max(range(WIDTH), key=lambda x: len(ink[x]))
    for x in range(staff - 30, staff):  # the minor marks begin nearer to the staff
        marks = clusters(ink[x])[-len(MAJOR_MARKS_M) :]  # above them stands the unit
        steps = [b - a for a, b in zip(marks, marks[1:])]
        if len(marks) == len(MAJOR_MARKS_M) and max(steps) < 1.1 * min(steps):
            return marks
    raise AssertionError("no ruler in the picture")


def height_of_row(y, marks):
    """Metres at a row: a straight scale in perspective, h = (a + b y) / (1 + c y), through three marks."""
    (y0, h0), (y1, h1), (y2, h2) = [(marks[i], MAJOR_MARKS_M[i]) for i in (0, 2, 4)]
    # Cross ratios are kept: (h - h0)(h1 - h2) / ((h - h2)(h1 - h0)) is the same of the rows.
    ratio = (y - y0) * (y1 - y2) / ((y - y2) * (y1 - y0)) * (h1 - h0) / (h1 - h2)
    return (h0 - ratio * h2) / (1 - ratio)


def bottom_row(picture):
    """The lower edge of the orange ball."""
    rows = [y for y in range(HEIGHT) if any(p[0] > p[2] + 45 for p in picture[y])]
    return rows[-1] + 0.5


class Figure8(ProgramTest):
    def test_the_film_shows_the_heights(self):
        fall = math.sqrt(2 * 1.8 / 9.81)
        time = fall
        for n in range(1, 4):
            rise = RESTITUTION**n * fall
            expected = RESTITUTION ** (2 * n) * 1.8
            still = self.folder / f"{n}.png"
            self.assert_exit(0, run("still", SCENE, "--time", time + rise, "-o", still, "--set", "overlay.labels=false"))
            picture = pixels(still)
            read = height_of_row(bottom_row(picture), major_marks(picture))
            print(f"rebound {n}: read off the picture {read:.4f} m, closed form {expected:.4f} m")
            self.assertAlmostEqual(expected, read, delta=READING_ERROR_M)
            time += 2 * rise


if __name__ == "__main__":
    unittest.main()
