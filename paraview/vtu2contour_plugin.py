"""ParaView plugin: *DEI Contour*, *DEI Monitor* and *DEI Refine*, under *Filters > DEI*.

They contour the cubics that vtu2contour makes of values, gradients and the PDE, say where the mesh
should be finer, and refine meshes whose new points have the cubics' values. The work is done in
memory by the Python module ``vtu2contour``; how both are installed is in the README beside this
file.
"""

import warnings

from paraview.util.vtkAlgorithm import smhint, smproperty, smproxy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

paraview_plugin_name = "vtu2contour"
paraview_plugin_version = "0.1.0"

MISSING = (
    "the Python module vtu2contour is missing: run paraview/install.sh of its sources, or install "
    "it with `pip install --target FOLDER` and start ParaView with PYTHONPATH=FOLDER"
)

AUTOMATIC = "Automatic"
INTERPOLANTS = ("pci", "linear", "quadratic-precision")
METHODS = ("aodea", "odea", "sode", "intercept")
AS_INPUT = 2
SELECTIONS = ("average", "fraction", "bulk", "tolerance")

# What is known of the solution.
SOLUTION_PROPERTIES = """
<StringVectorProperty name="Gradient" command="SetGradient" number_of_elements="1"
    default_values="Automatic" animateable="0">
  <ArrayListDomain name="array_list" attribute_type="Vectors" none_string="Automatic">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The point array that is the gradient of the array, per unit of length.
    Automatic: one with a usual name that fits the values, such as grad_u; else the gradient is
    recovered from the values.</Documentation>
</StringVectorProperty>
<IntVectorProperty name="RecoverGradient" label="Recover Gradient" command="SetRecoverGradient"
    number_of_elements="1" default_values="0" panel_visibility="advanced">
  <BooleanDomain name="bool"/>
  <Documentation>Recover the gradient from the values even if an array holds it.</Documentation>
</IntVectorProperty>
<StringVectorProperty name="PDE" label="PDE" command="SetPDE" number_of_elements="1"
    default_values="" animateable="0">
  <Documentation>The equation that the array solves, if it is known: the cubics solve it too.
    For example uxx + uyy = -k2*u. There, the array is always u; x y z, ux uy uz,
    uxx ... uyz, sin, cos, exp ... may occur, point arrays by their names, and the
    parameters.</Documentation>
</StringVectorProperty>
<StringVectorProperty name="Parameters" label="PDE Parameters" command="SetParameters"
    number_of_elements="1" default_values="" panel_visibility="advanced">
  <Documentation>Values of names in the PDE, such as k2=84.39, c=1.</Documentation>
</StringVectorProperty>
"""

# All properties, in the order of the panel. (ParaView 5.11 sorts those of methods by name.)
CONTOUR_PROPERTIES = """
<InputProperty name="Input" command="SetInputConnection">
  <ProxyGroupDomain name="groups"><Group name="sources"/><Group name="filters"/></ProxyGroupDomain>
  <DataTypeDomain name="input_type"><DataType value="vtkDataSet"/></DataTypeDomain>
  <InputArrayDomain name="input_array" attribute_type="point" number_of_components="1"/>
  <Documentation>The mesh. Its two-dimensional cells have contour lines, its solids
    iso-surfaces. Meshes of blocks are contoured block by block.</Documentation>
</InputProperty>
<StringVectorProperty name="SelectInputScalars" label="Contour By"
    command="SetInputArrayToProcess" number_of_elements="5" element_types="0 0 0 0 2"
    animateable="0">
  <ArrayListDomain name="array_list" attribute_type="Scalars" input_domain_name="input_array">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The point array that is contoured.</Documentation>
</StringVectorProperty>
<DoubleVectorProperty name="ContourValues" label="Isosurfaces" command="SetValue"
    number_of_elements="0" number_of_elements_per_command="1" repeat_command="1" use_index="1"
    set_number_command="SetNumberOfContours" animateable="1">
  <ArrayRangeDomain name="scalar_range">
    <RequiredProperties>
      <Property name="Input" function="Input"/>
      <Property name="SelectInputScalars" function="ArraySelection"/>
    </RequiredProperties>
  </ArrayRangeDomain>
  <Documentation>The levels, in the unit of the array. Moving one costs only the contour: the
    cubics are kept while the input is the same.</Documentation>
</DoubleVectorProperty>
"""

DRAWING_PROPERTIES = """
<DoubleVectorProperty name="Tolerance" command="SetTolerance" number_of_elements="1"
    default_values="0">
  <DoubleRangeDomain name="range" min="0"/>
  <Documentation>No segment or triangle is further than this from the contour, in the unit of
    length of the mesh. 0: by the size of the mesh, 1e-5 of its diagonal for lines and 1e-3 for
    surfaces.</Documentation>
</DoubleVectorProperty>
<IntVectorProperty name="PointsPerSide" label="Points Per Side" command="SetPointsPerSide"
    number_of_elements="1" default_values="0">
  <IntRangeDomain name="range" min="0" max="64"/>
  <Documentation>Points on each side of a patch of a surface, 2 or more, instead of a tolerance.
    0: by the tolerance.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="ComputeNormals" label="Compute Normals" command="SetComputeNormals"
    number_of_elements="1" default_values="1">
  <BooleanDomain name="bool"/>
  <Documentation>Add Normals to the points: those of the cubics, along the falling
    gradient.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="ComputeGradients" label="Compute Gradients"
    command="SetComputeGradients" number_of_elements="1" default_values="0">
  <BooleanDomain name="bool"/>
  <Documentation>Add the gradients of the cubics to the points, as Gradients.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="Method" command="SetMethod" number_of_elements="1" default_values="0"
    panel_visibility="advanced">
  <EnumerationDomain name="enum">
    <Entry value="0" text="AODEA"/><Entry value="1" text="ODEA"/>
    <Entry value="2" text="SODE"/><Entry value="3" text="Intercept"/>
  </EnumerationDomain>
  <Documentation>How lines are drawn between the edges of a cell.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="Interpolant" command="SetInterpolant" number_of_elements="1"
    default_values="0" panel_visibility="advanced">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Cubic (PCI)"/><Entry value="1" text="Linear"/>
    <Entry value="2" text="Quadratic precision"/>
  </EnumerationDomain>
  <Documentation>What is contoured: the cubics; for comparison, cubics of each cell by itself, or
    the linear interpolant of the values.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="OutputPointsPrecision" label="Output Points Precision"
    command="SetOutputPointsPrecision" number_of_elements="1" default_values="2"
    panel_visibility="advanced">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Single"/><Entry value="1" text="Double"/>
    <Entry value="2" text="Same as input"/>
  </EnumerationDomain>
  <Documentation>The precision of the points.</Documentation>
</IntVectorProperty>
"""


class SolutionFilter(VTKPythonAlgorithmBase):
    """A filter that makes something of the interpolant of its input.

    The interpolant is kept while the input and what is known of the solution stay the same.
    """

    #: what messages call it
    NAME = ""

    def __init__(self, output_type):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType=output_type)
        self._solution = {}
        self._parameters = ""
        self._recover = False
        self._gradient = AUTOMATIC
        #: the interpolant of the input that was seen last, and what it was made of
        self._kept = (None, None)

    def SetGradient(self, name):
        self._change("_gradient", name or AUTOMATIC)

    def SetRecoverGradient(self, recover):
        self._change("_recover", bool(recover))

    def SetPDE(self, text):
        # no text is None in some versions of ParaView, and "" in others
        self._choose(self._solution, "pde", (text or "").strip() or None)

    def SetParameters(self, text):
        self._change("_parameters", text or "")

    def _change(self, name, value):
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def _choose(self, options, name, value):
        if options.get(name) != value:
            options[name] = value
            self.Modified()

    # the pipeline

    def FillInputPortInformation(self, port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
        info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        return 1

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), "vtkDataObject")
        return 1

    def RequestUpdateExtent(self, request, inputs, outputs):
        """Cells of neighbouring processes are wanted: gradients are recovered with them."""
        levels = vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_GHOST_LEVELS()
        info = inputs[0].GetInformationObject(0)
        info.Set(levels, max(info.Get(levels), 1))
        return 1

    def RequestData(self, request, inputs, outputs):
        mesh = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        output.Initialize()
        try:
            import vtu2contour
        except ImportError as error:
            tell_error(f"{MISSING} ({error})", self.NAME)
            return 1
        size = diagonal_of_all(mesh)
        if not has_cells(mesh):
            return 1  # another process has them
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("ignore")
            warnings.simplefilter("always", UserWarning)
            try:
                made = self._interpolant(vtu2contour, mesh)
                output.ShallowCopy(self._made(made, size))
            except vtu2contour.NothingToContourError as error:
                if processes() == 1:
                    tell_error(error, self.NAME)
            except (ValueError, TypeError) as error:
                tell_error(error, self.NAME)
        for warning in told:
            tell_warning(warning.message, self.NAME)
        return 1

    def _made(self, interpolant, size):
        """What is made of the interpolant; ``size``: the diagonal of all processes' meshes."""
        raise NotImplementedError

    def _interpolant(self, vtu2contour, mesh):
        """The interpolant of the input: the one that was made before, if all is as it was."""
        array = self.GetInputArrayInformation(0)
        options = {
            **self._solution,
            "scalars": array.Get(vtkDataObject.FIELD_NAME()) or None,
            "parameters": parameters(self._parameters),
            "gradient": None if self._gradient == AUTOMATIC else self._gradient,
        }
        if self._recover:
            options["gradient"] = "recover"
        key = (state_of(mesh), options)
        if self._kept[0] != key:
            self._kept = (None, None)  # the memory of the old one is free before the new one
            self._kept = (key, vtu2contour.MeshInterpolant(mesh, **options))
        return self._kept[1]


@smproxy.filter(name="DEIContour", label="DEI Contour")
@smhint.xml('<ShowInMenu category="DEI"/><Visibility replace_input="2"/>')
@smproperty.xml(CONTOUR_PROPERTIES + SOLUTION_PROPERTIES + DRAWING_PROPERTIES)
class DEIContour(SolutionFilter):
    """Contours the cubics of the Differential Equation Interpolant."""

    NAME = "DEI Contour"

    def __init__(self):
        super().__init__("vtkPolyData")
        self._values = []
        self._drawing = {"normals": True, "double": None}

    def SetInterpolant(self, number):
        self._choose(self._solution, "interpolant", INTERPOLANTS[number])

    # how contours are drawn

    def SetNumberOfContours(self, count):
        if count != len(self._values):
            self._values = (self._values + [0.0] * count)[:count]
            self.Modified()

    def SetValue(self, place, value):
        self._values += [0.0] * (place + 1 - len(self._values))
        if self._values[place] != value:
            self._values[place] = value
            self.Modified()

    def SetTolerance(self, tolerance):
        self._choose(self._drawing, "tolerance", tolerance or None)

    def SetPointsPerSide(self, points):
        self._choose(self._drawing, "nside", points or None)

    def SetComputeNormals(self, wanted):
        self._choose(self._drawing, "normals", bool(wanted))

    def SetComputeGradients(self, wanted):
        self._choose(self._drawing, "gradients", bool(wanted))

    def SetMethod(self, number):
        self._choose(self._drawing, "method", METHODS[number])

    def SetOutputPointsPrecision(self, number):
        self._choose(self._drawing, "double", None if number == AS_INPUT else bool(number))

    # the pipeline

    def RequestDataObject(self, request, inputs, outputs):
        """The output is a mesh of blocks if the input is."""
        mesh = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        wanted = mesh.NewInstance() if mesh.IsA("vtkCompositeDataSet") else vtkPolyData()
        if output is None or output.GetClassName() != wanted.GetClassName():
            outputs.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), wanted)
        return 1

    def _made(self, interpolant, size):
        return interpolant.contour(self._values, size=size, **self._drawing)


MONITOR_PROPERTIES = """
<InputProperty name="Input" command="SetInputConnection">
  <ProxyGroupDomain name="groups"><Group name="sources"/><Group name="filters"/></ProxyGroupDomain>
  <DataTypeDomain name="input_type"><DataType value="vtkDataSet"/></DataTypeDomain>
  <InputArrayDomain name="input_array" attribute_type="point" number_of_components="1"/>
  <Documentation>The mesh. Its solids are judged, or if it has none its two-dimensional cells.
    Meshes of blocks are judged block by block.</Documentation>
</InputProperty>
<StringVectorProperty name="Solution" label="Solution"
    command="SetInputArrayToProcess" number_of_elements="5" element_types="0 0 0 0 2"
    animateable="0">
  <ArrayListDomain name="array_list" attribute_type="Scalars" input_domain_name="input_array">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The point array whose cubics are judged.</Documentation>
</StringVectorProperty>
<IntVectorProperty name="Monitor" command="SetMonitor" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Defect"/><Entry value="1" text="Surface area"/>
    <Entry value="2" text="Stepwise error"/><Entry value="3" text="Interpolation error"/>
  </EnumerationDomain>
  <Documentation>The number of each cell. Defect: how far the cubic is from satisfying the PDE,
    integrated over the cell. Surface area: that of the cubic's graph. Stepwise error: the mean
    difference to the cubics on the mesh with every edge halved. Interpolation error: the mean
    difference to the second interpolant.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="Second" label="Second Interpolant" command="SetSecond"
    number_of_elements="1" default_values="0" panel_visibility="advanced">
  <EnumerationDomain name="enum">
    <Entry value="0" text="By what is known"/><Entry value="1" text="Pure quartic (PQI)"/>
    <Entry value="2" text="Full quartic (FQI)"/><Entry value="3" text="Pure tri-cubic (p3)"/>
    <Entry value="4" text="Quadratic precision"/><Entry value="5" text="Linear"/>
  </EnumerationDomain>
  <Documentation>What the interpolation error compares the cubics with. Quartics are on triangles,
    the tri-cubic in tetrahedra; these three need the PDE.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="Select" command="SetSelect" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="None"/><Entry value="1" text="Above N times the average"/>
    <Entry value="2" text="The part N of the cells"/>
    <Entry value="3" text="The fewest with the part N of the sum"/>
    <Entry value="4" text="Above N"/>
  </EnumerationDomain>
  <Documentation>Which cells are marked, in a cell array of its own: 1 for those, 0 for others. DEI
    Refine takes it. N is the number below.</Documentation>
</IntVectorProperty>
<DoubleVectorProperty name="Number" label="N" command="SetNumber" number_of_elements="1"
    default_values="2">
  <DoubleRangeDomain name="range" min="0"/>
  <Documentation>A factor, a part between 0 and 1, or a number in the unit of the
    monitor.</Documentation>
</DoubleVectorProperty>
<IntVectorProperty name="RandomSamples" label="Random Samples" command="SetRandomSamples"
    number_of_elements="1" default_values="0" panel_visibility="advanced">
  <IntRangeDomain name="range" min="0" max="65535"/>
  <Documentation>So many random points of each cell are looked at; 0: fixed ones, which are mirrored
    with the cell.</Documentation>
</IntVectorProperty>
"""

MONITORS = ("defect", "area", "stepwise", "interpolation")
SECONDS = (None, "pqi", "fqi", "p3", "quadratic-precision", "linear")


@smproxy.filter(name="DEIMonitor", label="DEI Monitor")
@smhint.xml('<ShowInMenu category="DEI"/>')
@smproperty.xml(MONITOR_PROPERTIES + SOLUTION_PROPERTIES)
class DEIMonitor(SolutionFilter):
    """Says how much each cell needs to be refined, as a cell array."""

    NAME = "DEI Monitor"

    def __init__(self):
        super().__init__("vtkDataSet")
        self._options = {"kind": MONITORS[0]}
        self._selection = 0
        self._number = 2.0

    def SetMonitor(self, number):
        self._choose(self._options, "kind", MONITORS[number])

    def SetSecond(self, number):
        self._choose(self._options, "second", SECONDS[number])

    def SetSelect(self, number):
        self._change("_selection", number)

    def SetNumber(self, number):
        self._change("_number", number)

    def SetRandomSamples(self, count):
        self._choose(self._options, "samples", count or None)

    def RequestDataObject(self, request, inputs, outputs):
        """The output is what the input is."""
        mesh = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        if output is None or output.GetClassName() != mesh.GetClassName():
            outputs.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), mesh.NewInstance())
        return 1

    def _made(self, interpolant, size):
        select = None
        if self._selection > 0:
            select = f"{SELECTIONS[self._selection - 1]}:{self._number!r}"
        return interpolant.monitor(select=select, **self._options)


REFINE_PROPERTIES = """
<InputProperty name="Input" command="SetInputConnection">
  <ProxyGroupDomain name="groups"><Group name="sources"/><Group name="filters"/></ProxyGroupDomain>
  <DataTypeDomain name="input_type"><DataType value="vtkDataSet"/></DataTypeDomain>
  <InputArrayDomain name="cell_array" attribute_type="cell" number_of_components="1"/>
  <Documentation>The mesh. Its solids are refined, or if it has none its two-dimensional cells; all
    become tetrahedra or triangles first.</Documentation>
</InputProperty>
<StringVectorProperty name="RefineBy" label="Refine By" command="SetInputArrayToProcess"
    number_of_elements="5" element_types="0 0 0 0 2" animateable="0">
  <ArrayListDomain name="array_list" attribute_type="Scalars" input_domain_name="cell_array">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The cell array that says where: an error indicator, or marks.</Documentation>
</StringVectorProperty>
<IntVectorProperty name="Select" command="SetSelect" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Above Number times the average"/>
    <Entry value="1" text="This part of the cells"/>
    <Entry value="2" text="The fewest with this part of the sum"/>
    <Entry value="3" text="Above Number"/><Entry value="4" text="Other than zero"/>
  </EnumerationDomain>
  <Documentation>Which cells the array selects, by the number below.</Documentation>
</IntVectorProperty>
<DoubleVectorProperty name="Number" command="SetNumber" number_of_elements="1"
    default_values="2">
  <DoubleRangeDomain name="range" min="0"/>
  <Documentation>A factor, a part between 0 and 1, or a number in the unit of the
    array.</Documentation>
</DoubleVectorProperty>
<IntVectorProperty name="Method" command="SetMethod" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="Longest edge"/><Entry value="1" text="Newest vertex"/>
    <Entry value="2" text="Red-green"/><Entry value="3" text="Centroid"/>
    <Entry value="4" text="Delaunay"/>
  </EnumerationDomain>
  <Documentation>How triangles are divided; Delaunay, the thesis' hybrid, takes meshes in a plane.
    Tetrahedra are always bisected.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="Smooth" command="SetSmooth" number_of_elements="1" default_values="0">
  <EnumerationDomain name="enum">
    <Entry value="0" text="No"/><Entry value="1" text="Laplacian"/>
    <Entry value="2" text="Optimised"/>
  </EnumerationDomain>
  <Documentation>Moves points of triangles so that these have better shapes. The boundary
    stays.</Documentation>
</IntVectorProperty>
<IntVectorProperty name="MaximumPoints" label="Maximum Points" command="SetMaximumPoints"
    number_of_elements="1" default_values="0">
  <IntRangeDomain name="range" min="0"/>
  <Documentation>The most points that the refined mesh may have; 0 for any
    number.</Documentation>
</IntVectorProperty>
<StringVectorProperty name="Solution" command="SetSolution" number_of_elements="1"
    default_values="Automatic" animateable="0">
  <ArrayListDomain name="array_list" attribute_type="Scalars" none_string="Automatic">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The point array whose new values are those of the cubics; others are interpolated
    linearly. Automatic: the active scalars, or the only one.</Documentation>
</StringVectorProperty>
<StringVectorProperty name="Gradient" command="SetGradient" number_of_elements="1"
    default_values="Automatic" animateable="0" panel_visibility="advanced">
  <ArrayListDomain name="array_list" attribute_type="Vectors" none_string="Automatic">
    <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
  </ArrayListDomain>
  <Documentation>The point array that is its gradient. Automatic: one with a usual name that fits,
    else it is recovered.</Documentation>
</StringVectorProperty>
<StringVectorProperty name="PDE" label="PDE" command="SetPDE" number_of_elements="1"
    default_values="" animateable="0">
  <Documentation>The equation that the solution solves, if it is known: as in DEI
    Contour.</Documentation>
</StringVectorProperty>
<StringVectorProperty name="Parameters" label="PDE Parameters" command="SetParameters"
    number_of_elements="1" default_values="" panel_visibility="advanced">
  <Documentation>Values of names in the PDE, such as k2=84.39, c=1.</Documentation>
</StringVectorProperty>
"""

DIVISIONS = ("bisect", "newest-vertex", "red-green", "centroid", "delaunay")
SMOOTHINGS = (None, "laplacian", "optimised")


@smproxy.filter(name="DEIRefine", label="DEI Refine")
@smhint.xml('<ShowInMenu category="DEI"/>')
@smproperty.xml(REFINE_PROPERTIES)
class DEIRefine(VTKPythonAlgorithmBase):
    """Refines a mesh where a cell array asks for it, with all its data."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkUnstructuredGrid")
        self._options = {}
        self._selection = 0
        self._number = 2.0
        self._parameters = ""

    def SetSelect(self, number):
        self._change("_selection", number)

    def SetNumber(self, number):
        self._change("_number", number)

    def SetParameters(self, text):
        self._change("_parameters", text or "")

    def SetMethod(self, number):
        self._choose("method", DIVISIONS[number])

    def SetSmooth(self, number):
        self._choose("smooth", SMOOTHINGS[number])

    def SetMaximumPoints(self, points):
        self._choose("max_points", points or None)

    def SetSolution(self, name):
        self._choose("scalars", None if name in (None, "", AUTOMATIC) else name)

    def SetGradient(self, name):
        self._choose("gradient", None if name in (None, "", AUTOMATIC) else name)

    def SetPDE(self, text):
        self._choose("pde", (text or "").strip() or None)

    def _change(self, name, value):
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def _choose(self, name, value):
        if self._options.get(name) != value:
            self._options[name] = value
            self.Modified()

    def FillInputPortInformation(self, port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
        return 1

    def RequestData(self, request, inputs, outputs):
        mesh = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        output.Initialize()
        try:
            import vtu2contour
        except ImportError as error:
            tell_error(f"{MISSING} ({error})", "DEI Refine")
            return 1
        if mesh.GetNumberOfCells() == 0:
            return 1  # another process has them
        name = self.GetInputArrayInformation(0).Get(vtkDataObject.FIELD_NAME())
        if self._selection < len(SELECTIONS):
            where = {"by": name, "select": f"{SELECTIONS[self._selection]}:{self._number!r}"}
        else:
            where = {"marks": name}
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("ignore")
            warnings.simplefilter("always", UserWarning)
            try:
                options = {**self._options, "parameters": parameters(self._parameters)}
                output.ShallowCopy(vtu2contour.refine(mesh, **where, **options))
            except (ValueError, TypeError) as error:
                tell_error(error, "DEI Refine")
        for warning in told:
            tell_warning(warning.message, "DEI Refine")
        return 1


def parameters(text):
    """The numbers of a text such as ``k2=84.39, c=1``."""
    values = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, value = part.partition("=")
        try:
            values[name.strip()] = float(value)
        except ValueError:
            raise ValueError(f"PDE parameters are written name=number, not '{part}'") from None
    return values


def leaves(mesh):
    """The meshes that a mesh of blocks is made of, or it alone."""
    if not mesh.IsA("vtkCompositeDataSet"):
        return [mesh]
    iterator, found = mesh.NewIterator(), []
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return [leaf for leaf in found if leaf.IsA("vtkDataSet")]


def has_cells(mesh):
    """Whether there is anything to contour here."""
    return any(leaf.GetNumberOfCells() for leaf in leaves(mesh))


def state_of(mesh):
    """What changes whenever a mesh or its data do: VTK's times are never the same twice.

    Those of a grid itself will not do: readers hand the same arrays over in a new grid whenever
    they are asked.
    """
    return [(state_of_cells(leaf), state_of_data(leaf)) for leaf in leaves(mesh)]


def state_of_cells(leaf):
    """When the points and the cells were changed."""
    if leaf.IsA("vtkUnstructuredGrid") and leaf.GetPoints() is not None:
        return leaf.GetPoints().GetMTime(), leaf.GetCells().GetMTime()
    return (leaf.GetMTime(),)


def state_of_data(leaf):
    """When each array was changed, and which are the active scalars."""
    all_data = (leaf.GetPointData(), leaf.GetCellData(), leaf.GetFieldData())
    arrays = [
        data.GetAbstractArray(n) for data in all_data for n in range(data.GetNumberOfArrays())
    ]
    active = leaf.GetPointData().GetScalars()
    times = [(array.GetName(), array.GetMTime()) for array in arrays]
    return times, None if active is None else active.GetName()


def processes():
    """How many processes work together."""
    controller = vtkMultiProcessController.GetGlobalController()
    return 1 if controller is None else controller.GetNumberOfProcesses()


def diagonal_of_all(mesh):
    """The length of the diagonal of the box around the meshes of all processes, by which
    pieces are equally fine where they meet; nothing for a single process."""
    if processes() == 1:
        return None
    controller = vtkMultiProcessController.GetGlobalController()
    boxes = [leaf.GetBounds() for leaf in leaves(mesh) if leaf.GetNumberOfPoints()]
    # what is least of the negative is greatest
    own = [max((sign * box[n] for box in boxes), default=-1e300) for n, sign in CORNERS]
    here, there = vtkDoubleArray(), vtkDoubleArray()
    for value in own:
        here.InsertNextValue(value)
    there.SetNumberOfValues(len(own))
    controller.AllReduce(here, there, vtkCommunicator.MAX_OP)
    sides = [there.GetValue(n) + there.GetValue(n + 3) for n in range(3)]
    return sum(side**2 for side in sides) ** 0.5 if min(sides) >= 0 else None


#: Places in VTK's bounds of the upper corner, and of the lower one with its sign turned.
CORNERS = [(1, 1), (3, 1), (5, 1), (0, -1), (2, -1), (4, -1)]


def tell_error(text, name):
    """An error in ParaView's output messages, of the filter of that name."""
    vtkOutputWindow.GetInstance().DisplayErrorText(f"{name}: {text}\n")


def tell_warning(text, name):
    """A warning in ParaView's output messages, of the filter of that name."""
    vtkOutputWindow.GetInstance().DisplayWarningText(f"{name}: {text}\n")
