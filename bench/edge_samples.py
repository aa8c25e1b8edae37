#!/usr/bin/env python3
"""How well few samples in a pixel see straight edges of every direction and place: the part of the
pixel on one side by the lattice of src/render/shaders/background_fragment.glsl and by square grids,
against 8 x 8 samples. Prints the largest and the root mean square error, in parts of the contrast.
"""
import bisect
import math


def grid(n):
    return [((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5) for i in range(n) for j in range(n)]


def lattice(n, step, first):
    return [((k - (n - 1) / 2) / n, ((step * k + first) % n - (n - 1) / 2) / n) for k in range(n)]


DIRECTIONS, PLACES, REACH = 720, 376, 0.75
REFERENCE = grid(8)


def errors(samples):
    worst, squares, count = 0.0, 0.0, 0
    for turn in range(DIRECTIONS):
        angle = 2 * math.pi * turn / DIRECTIONS + 1e-4
        x, y = math.cos(angle), math.sin(angle)
        seen = sorted(x * a + y * b for a, b in samples)
        reference = sorted(x * a + y * b for a, b in REFERENCE)
        for k in range(PLACES):
            edge = -REACH + 2 * REACH * k / (PLACES - 1)
            wanted = bisect.bisect_left(reference, edge) / len(reference)
            error = abs(bisect.bisect_left(seen, edge) / len(seen) - wanted)
            worst = max(worst, error)
            # Edges that cut the pixel's square.
            if abs(edge) < 0.5 * (abs(x) + abs(y)):
                squares += error * error
                count += 1
    return worst, math.sqrt(squares / count)


for name, samples in (("lattice of 24", lattice(24, 5, 8)), ("lattice of 32", lattice(32, 7, 19)),
                      ("grid of 5 x 5", grid(5)), ("grid of 6 x 6", grid(6))):
    print(f"{name:<14} largest {errors(samples)[0]:.3f}, rms {errors(samples)[1]:.4f}")
