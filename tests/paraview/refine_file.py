"""In pvpython: refines a file with the filter, once for each set of properties.

Arguments: the plugin, the file, and a JSON file that lists ``output`` and ``properties``.
"""

import json
import sys

from paraview.servermanager import Fetch
from paraview.simple import LoadPlugin, OpenDataFile
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

LoadPlugin(sys.argv[1], remote=False, ns=globals())
refine = DEIRefine(Input=OpenDataFile(sys.argv[2]))  # noqa: F821 (the plugin's)
for job in json.load(open(sys.argv[3])):
    print("job", job["output"], flush=True)
    for name, value in job["properties"].items():
        setattr(refine, name, value)
    refine.UpdatePipeline()
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(job["output"])
    writer.SetInputData(Fetch(refine))
    writer.Write()
