"""In pvpython: judges the cells of a file with the filter, once for each set of properties.

Arguments: the plugin, the file, and a JSON file that lists ``output`` and ``properties``.
"""

import json
import sys

from paraview.servermanager import Fetch
from paraview.simple import LoadPlugin, OpenDataFile
from vtkmodules.vtkIOXML import vtkXMLDataSetWriter, vtkXMLMultiBlockDataWriter

LoadPlugin(sys.argv[1], remote=False, ns=globals())
for job in json.load(open(sys.argv[3])):
    print("job", job["output"], flush=True)
    source = OpenDataFile(job.get("file", sys.argv[2]))
    monitor = DEIMonitor(Input=source)  # noqa: F821 (the plugin's)
    for name, value in job["properties"].items():
        setattr(monitor, name, value)
    monitor.UpdatePipeline()
    data = Fetch(monitor)
    is_of_blocks = data.IsA("vtkCompositeDataSet")
    writer = vtkXMLMultiBlockDataWriter() if is_of_blocks else vtkXMLDataSetWriter()
    writer.SetFileName(job["output"])
    writer.SetInputData(data)
    writer.Write()
