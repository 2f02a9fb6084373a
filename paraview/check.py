"""Contours a cube in pvpython; ``install.sh`` ends with this."""

import sys

from paraview.simple import Calculator, LoadPlugin, Tetrahedralize, Wavelet

LoadPlugin(sys.argv[1], remote=False, ns=globals())
wavelet = Wavelet(WholeExtent=[-3, 3, -3, 3, -3, 3])
cubic = Calculator(Input=wavelet, ResultArrayName="u", Function="coordsX^2+coordsY^2+coordsZ^2")
surface = DEIContour(Input=Tetrahedralize(Input=cubic))  # noqa: F821 (the plugin's)
surface.ContourBy = ["POINTS", "u"]
surface.Isosurfaces = [4.0]
surface.UpdatePipeline()
assert surface.GetDataInformation().GetNumberOfCells() > 100
print("DEI Contour works")
