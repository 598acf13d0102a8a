#!/usr/bin/env python3
"""Writes a catenoid as films.vtp: the form of file that [foam.films] reads, with nothing but the standard library.

The film hangs between two rings of 2 mm radius about the axis z; below it is phase 1, outside it phase 0.
"""
import math

AROUND, ALONG = 60, 22  # edges
NECK = 1.295e-3  # radius of the neck, a [m]: r = a cosh(z/a)
HALF_HEIGHT = 1.3e-3  # of the film [m]
HALF_THICKNESS = 5e-6  # eta [m]

points = []
for j in range(ALONG + 1):
    z = HALF_HEIGHT * (2 * j / ALONG - 1)
    r = NECK * math.cosh(z / NECK)
    for i in range(AROUND):
        angle = 2 * math.pi * (i + 0.5 * (j % 2)) / AROUND
        points.append((r * math.cos(angle), r * math.sin(angle), z))

# The normal of a triangle, by the right-hand rule, points from phase_a = 0 into phase_b = 1: towards the axis.
triangles = []
for j in range(ALONG):
    for i in range(AROUND):
        a, b = j * AROUND + i, j * AROUND + (i + 1) % AROUND
        c, d = a + AROUND, b + AROUND
        triangles += [(a, c, b), (b, c, d)] if j % 2 == 0 else [(a, d, b), (a, c, d)]


def array(name, values, kind="Float64", extra=""):
    text = " ".join(f"{v:.6g}" if kind == "Float64" else str(v) for v in values)
    return f'<DataArray type="{kind}" Name="{name}" format="ascii"{extra}>{text}</DataArray>\n'


n = len(triangles)
with open("films.vtp", "w", encoding="ascii") as out:
    out.write('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">\n<PolyData>\n')
    out.write("<FieldData>" + array("TimeValue", [0.0], extra=' NumberOfTuples="1"') + "</FieldData>\n")
    out.write(f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{n}">\n')
    out.write("<Points>" + array("Points", [x for p in points for x in p], extra=' NumberOfComponents="3"') + "</Points>\n")
    out.write("<PointData>" + array("half_thickness_m", [HALF_THICKNESS] * len(points)))
    out.write(array("border_area_m2", [0.0] * len(points)) + "</PointData>\n")
    out.write("<CellData>" + array("lamella", [0] * n, "Int32") + array("phase_a", [0] * n, "Int32"))
    out.write(array("phase_b", [1] * n, "Int32") + "</CellData>\n")
    out.write("<Polys>" + array("connectivity", [p for t in triangles for p in t], "Int32"))
    out.write(array("offsets", [3 * (k + 1) for k in range(n)], "Int32") + "</Polys>\n")
    out.write("</Piece>\n</PolyData>\n</VTKFile>\n")
