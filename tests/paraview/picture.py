"""In pvpython with a display: ParaView's own Contour and DEI Contour side by side.

Arguments: the plugin and the picture (.png). The function has an exact gradient and a surface
of two sheets, on 2560 tetrahedra.
"""

import sys

from paraview.simple import (
    Calculator,
    ColorBy,
    Contour,
    CreateLayout,
    CreateRenderView,
    LoadPlugin,
    SaveScreenshot,
    Show,
    Tetrahedralize,
    Text,
    Wavelet,
)

LoadPlugin(sys.argv[1], remote=False, ns=globals())
U = "coordsX^4+coordsY^4+coordsZ^4-14*(coordsX^2+coordsY^2+coordsZ^2)"
GRADIENT = "+".join(
    f"(4*coords{axis}^3-28*coords{axis})*{unit}Hat" for axis, unit in zip("XYZ", "ijk")
)
cube = Wavelet(WholeExtent=[-4, 4, -4, 4, -4, 4])
values = Calculator(Input=cube, ResultArrayName="u", Function=U)
gradients = Calculator(Input=values, ResultArrayName="grad_u", Function=GRADIENT)
mesh = Tetrahedralize(Input=gradients)
plain = Contour(Input=mesh, ContourBy=["POINTS", "u"], Isosurfaces=[-70.0], ComputeNormals=0)
cubic = DEIContour(Input=mesh)  # noqa: F821 (the plugin's)
cubic.ContourBy = ["POINTS", "u"]
cubic.Isosurfaces = [-70.0]
layout = CreateLayout("beside")
views = []
for surface, title in ((plain, "ParaView's Contour"), (cubic, "DEI Contour")):
    view = CreateRenderView()
    view.ViewSize = [600, 520]
    view.Background = [1.0, 1.0, 1.0]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    shown = Show(surface, view)
    ColorBy(shown, None)
    shown.DiffuseColor = [0.35, 0.55, 0.8]
    shown.Specular = 0.4
    label = Show(Text(Text=title), view)
    label.Color = [0.0, 0.0, 0.0]
    view.CameraPosition = [14, 9, 22]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    view.ResetCamera()
    views.append(view)
    layout.AssignView(0 if len(views) == 1 else 2, view)
    if len(views) == 1:
        layout.SplitHorizontal(0, 0.5)
layout.SetSize(1200, 520)
SaveScreenshot(sys.argv[2], layout, ImageResolution=[1200, 520])
