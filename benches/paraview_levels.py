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
ours = DEIContour(Input=mesh, PointsPerSide=2, ComputeNormals=1)  # noqa: F821 (the plugin's)
ours.SelectInputScalars = ["POINTS", "u"]
theirs = Contour(Input=mesh, ContourBy=["POINTS", "u"], ComputeNormals=1)
low, high = mesh.PointData["u"].GetRange()
seconds = ([], [])
for number in range(int(rounds) + 1):
    level = low + (high - low) * (0.4 + 0.2 * number / int(rounds))
    for contour, taken, values in (
        (ours, seconds[0], "ContourValues"),
        (theirs, seconds[1], "Isosurfaces"),
    ):
        setattr(contour, values, [level])
        start = time.perf_counter()
        UpdatePipeline(proxy=contour)
        taken.append(time.perf_counter() - start)
# the first level makes the interpolant
print(json.dumps([statistics.median(taken[1:]) for taken in seconds]))
