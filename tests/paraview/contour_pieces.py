"""In pvbatch, on several processes: each contours its piece of a file.

Arguments: the plugin, the file, the output (.pvtp), and the points per side (0: by tolerance).
"""

import sys

from paraview.simple import LoadPlugin, SaveData, XMLPartitionedUnstructuredGridReader

plugin, file, output, points = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
mesh = XMLPartitionedUnstructuredGridReader(FileName=[file])
contour = DEIContour(Input=mesh)  # noqa: F821 (the plugin's)
contour.ContourBy = ["POINTS", "u"]
contour.Isosurfaces = [0.5]
contour.PointsPerSide = int(points)
SaveData(output, proxy=contour)
