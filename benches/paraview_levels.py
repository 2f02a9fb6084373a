"""DEI Contour and ParaView's Contour at changing levels: prints the median seconds of both.

Run by `contours.py`: `pvpython paraview_levels.py PLUGIN FILE ROUNDS`.
"""

import json
import statistics
import sys
import time

from paraview.simple import Contour, LoadPlugin, OpenDataFile, UpdatePipeline

plugin, source, rounds = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
mesh = OpenDataFile(source)
mesh.UpdatePipeline()
ours = DEIContour(  # noqa: F821 (the plugin's)
    Input=mesh, ContourBy=["POINTS", "u"], PointsPerSide=2, ComputeNormals=1
)
theirs = Contour(Input=mesh, ContourBy=["POINTS", "u"], ComputeNormals=1)
low, high = mesh.PointData["u"].GetRange()
seconds = ([], [])
for number in range(int(rounds) + 1):
    level = low + (high - low) * (0.4 + 0.2 * number / int(rounds))
    for contour, taken in zip((ours, theirs), seconds, strict=True):
        contour.Isosurfaces = [level]
        start = time.perf_counter()
        UpdatePipeline(proxy=contour)
        taken.append(time.perf_counter() - start)
# the first level makes the interpolant
print(json.dumps([statistics.median(taken[1:]) for taken in seconds]))
