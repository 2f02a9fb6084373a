"""In pvpython: contours files with the filter, as a list of jobs says.

Arguments: the plugin, and a JSON file of jobs. Each job names a ``file``, an ``output`` and
``properties`` of the filter; a job with ``steps`` sets others one after the other, each with
an output of its own. What is printed at the end is how often an interpolant was made for each
job.
"""

import json
import sys

from paraview.servermanager import Fetch
from paraview.simple import GetTimeKeeper, LoadPlugin, OpenDataFile, UpdatePipeline
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter

import vtu2contour

LoadPlugin(sys.argv[1], remote=False, ns=globals())


class Counted(vtu2contour.MeshInterpolant):
    """Counts how many are made."""

    made = 0

    def __init__(self, *arguments, **options):
        Counted.made += 1
        super().__init__(*arguments, **options)


vtu2contour.MeshInterpolant = Counted


def write(data, path):
    is_poly_data = data.IsA("vtkPolyData")
    writer = vtkXMLPolyDataWriter() if is_poly_data else vtkXMLMultiBlockDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(data)
    writer.Write()


for job in json.load(open(sys.argv[2])):
    print("job", job["name"], flush=True)
    Counted.made = 0
    contour = DEIContour(Input=OpenDataFile(job["file"]))  # noqa: F821 (the plugin's)
    for step in job.get("steps", [{}]):
        for name, value in {**job["properties"], **step.get("properties", {})}.items():
            setattr(contour, name, value)
        UpdatePipeline(step.get("time", GetTimeKeeper().Time), contour)
        write(Fetch(contour), step.get("output", job.get("output")))
    print("made", job["name"], Counted.made, flush=True)
