#!/usr/bin/env python3
"""Writes a labelled voxel image of a foam in air: a stand-in for segmented tomography.

Usage: make_image.py OUTPUT.mha [VOXELS]

Twelve bubbles are the Voronoi cells of random points, cut off by a ball; their labels are 5, 10, 15, ...
with gaps, as a segmentation may leave them, in 16 bits, compressed. Needs nothing but Python's standard library.
"""

import array
import random
import sys
import zlib


def scattered(count, radius, spacing, rng):
    """Random points of a ball, no two nearer than the spacing."""
    points = []
    while len(points) < count:
        p = [rng.uniform(-radius, radius) for _ in range(3)]
        if sum(c * c for c in p) > radius * radius:
            continue
        if all(sum((a - b) ** 2 for a, b in zip(p, q)) > spacing * spacing for q in points):
            points.append(p)
    return points


def label_at(x, y, z, points, ball):
    """Label of the voxel at a place; lengths in halves of the image."""
    if x * x + y * y + z * z > ball * ball:
        return 0
    distance = [(x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 for a, b, c in points]
    return 5 * (1 + distance.index(min(distance)))


def main():
    path = sys.argv[1]
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 64
    ball = 0.72
    points = scattered(12, 0.55, 0.40, random.Random(7))
    centre = [(2 * i + 1) / n - 1 for i in range(n)]
    voxels = array.array("H", (label_at(x, y, z, points, ball) for z in centre for y in centre for x in centre))
    if sys.byteorder == "big":
        voxels.byteswap()
    data = zlib.compress(voxels.tobytes(), 9)
    size = 8e-3  # m
    header = (
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        f"CompressedData = True\nCompressedDataSize = {len(data)}\nDimSize = {n} {n} {n}\n"
        f"ElementSpacing = {size / n} {size / n} {size / n}\n"
        "ElementType = MET_USHORT\nElementDataFile = LOCAL\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        file.write(data)


if __name__ == "__main__":
    main()
